"""How well detectors find door jambs in point clouds."""
