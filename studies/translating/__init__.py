"""The learned translator: its training texts, its training and how it does beside the grammar."""
