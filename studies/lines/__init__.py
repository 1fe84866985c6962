"""How well lines explain real scans, and how true simulated walls are."""
