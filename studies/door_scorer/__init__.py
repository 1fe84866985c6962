"""Training of the scorer that tells doors from other gaps."""
