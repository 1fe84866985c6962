"""Learning to drive: what a policy sees, how it practises, how it is trained and kept."""
