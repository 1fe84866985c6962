"""The pictures and some of the tables of the documentation."""

from pathlib import Path

IMAGES = Path(__file__).resolve().parents[2] / "docs" / "images"
"""Where the documentation has its pictures."""
