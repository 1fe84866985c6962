"""The extractor of features against the truth of floor plans, and on real logs."""
