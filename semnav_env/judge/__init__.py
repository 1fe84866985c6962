"""The judge's side: what episodes are about, and whether the command was carried out."""
