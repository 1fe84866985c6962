"""Training on more than one machine, with RLlib on Ray."""
