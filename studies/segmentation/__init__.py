"""How much of the walls each strategy brings back in one piece."""
