"""Reads a text with one chart: words, spans, constituents, clauses, edits, programs, ranks."""
