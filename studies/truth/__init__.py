"""The truth twin of the feature extractor: what is in view, from the floor plan."""

from studies.truth.view import TrueView, true_scene

__all__ = ["TrueView", "true_scene"]
