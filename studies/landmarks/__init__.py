"""How exact fused corners and columns are, and what they add to drift correction and matching."""
