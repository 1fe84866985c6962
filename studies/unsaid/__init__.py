"""What doing what goes without saying is good for."""
