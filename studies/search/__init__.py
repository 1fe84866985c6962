"""How well houses are searched, with their plan and without."""
