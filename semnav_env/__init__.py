"""semnav-env: a Gymnasium environment for semantic indoor navigation."""
