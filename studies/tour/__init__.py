"""A tour of ten rooms of a villa with drift: what corrects it, and how well."""
