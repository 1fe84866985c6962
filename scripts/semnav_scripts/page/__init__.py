"""The page of `semnav serve`: requests, sessions, a server, and what the browser shows."""
