"""How fast the page of `semnav serve` is."""
