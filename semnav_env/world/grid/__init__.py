"""Functions on grids: reachable poses, distances, costs of paths, and cells in view.

- `cells.Grid`: corner, spacing and size of a grid.
- `occupancy`: the cells that solid segments pass through or come near.
- `distance`: how far each cell is from the nearest one that is marked.
- `costs`: the least cost of a path from each cell; the path; the nearest cell with a path.
- `rays`: the cells that are in view of a sensor.
- `poses`: the poses that a rectangular body reaches, turning where it must.

These modules do not use floor plans. `semnav_env.world.maps` applies them to a plan (`geodesic`,
`reach`, `reachability`). Whether a body has room at one exact pose is computed without a grid
(`maps.placement`).
"""
