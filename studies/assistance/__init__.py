"""What assistance is worth to clumsy drivers, and what it costs good ones."""
