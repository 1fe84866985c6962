"""Agents that drive: scripted, oracle, learned, and floors of benchmarks, behind one interface."""
