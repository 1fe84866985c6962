"""Recordings of a followed command for programs that show them: Rerun and Foxglove."""
