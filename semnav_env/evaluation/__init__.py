"""How well the senses do: measured against floor plans and against labelled logs."""
