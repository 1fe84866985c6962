"""Learning to drive: the observations of a policy, its training and its files."""
