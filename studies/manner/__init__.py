"""How robots drive at a pace, and along a wall."""
