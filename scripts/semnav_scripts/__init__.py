"""The `semnav` command line: thin entry points that nothing imports."""
