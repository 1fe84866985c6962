"""Where a body can be, how far a place is, and which cells are near: questions that grids answer.

- `cells.Grid`: where the cells lie.
- `occupancy`: the cells that something solid passes through, or comes near.
- `distance`: how far each cell is from the nearest one that is marked.
- `costs`: the least cost of the way from each cell; the way itself; the nearest cell with one.
- `rays`: the cells that are in view of a sensor.
- `poses`: the poses that a rectangular body reaches, turning where it must.

Nothing here knows floor plans. `semnav_env.world.maps` asks these questions of a plan
(`geodesic`, `reach`, `reachability`); whether a body has room at one exact pose is geometry without
a grid (`maps.placement`).
"""
