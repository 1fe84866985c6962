"""The `semnav` command line: thin entry points that no other package imports."""
