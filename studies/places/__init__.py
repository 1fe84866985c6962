"""Corridors told from other places by single scans."""
