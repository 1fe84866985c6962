"""Fixed distributions of generated offices; they never change, so that results compare."""

from semnav_env.world.maps.generator.settings import OfficeSettings

SMALL = OfficeSettings(
    rooms=(6, 16),
    crossings=((1, 2), (1, 2)),
    wings=0.5,
    wing=(4.0, 9.0),
    bay=(7.0, 12.0),
    room_width=(2.6, 4.6),
    loops=0.2,
    single_loaded=0.35,
)
"""A floor with six to sixteen rooms."""

MEDIUM = OfficeSettings()
"""A storey with sixteen to thirty-four rooms."""

LARGE = OfficeSettings(
    rooms=(40, 70), crossings=((2, 4), (2, 4)), bay=(12.0, 20.0), loops=0.5, open_areas=0.2
)
"""A building with forty to seventy rooms."""

HARD = OfficeSettings(
    rooms=(16, 40),
    crossings=((1, 4), (1, 4)),
    wings=0.4,
    bay=(8.0, 16.0),
    corridor_width=(1.5, 2.4),
    room_depth=(3.2, 6.0),
    room_width=(2.4, 5.5),
    loops=0.5,
    single_loaded=0.3,
    open_areas=0.35,
    door_width=(0.8, 1.2),
    closed=0.2,
    half_open=0.3,
    inner_doors=0.15,
    columns=0.5,
    furniture=0.8,
    glass=0.25,
    frameless=0.1,
)
"""As many rooms as medium, but narrow doors and corridors, leaves and things in the way, glass."""

HOUSE = OfficeSettings(
    rooms=(4, 9),
    crossings=((1, 1), (1, 1)),
    wings=0.3,
    wing=(4.0, 6.0),
    bay=(6.0, 9.0),
    corridor_width=(1.5, 2.0),
    room_depth=(3.2, 4.8),
    room_width=(2.8, 5.0),
    loops=0.0,
    single_loaded=0.2,
    open_areas=0.15,
    door_width=(0.85, 1.0),
    closed=0.0,
    half_open=0.1,
    inner_doors=0.25,
    columns=0.0,
    furniture=0.6,
    glass=0.0,
)
"""The storey of a house: four to nine rooms at a hall, all doors open, furniture."""

DISTRIBUTIONS = {"small": SMALL, "medium": MEDIUM, "large": LARGE, "hard": HARD}
"""The distributions of offices by their names."""

NAMED_SETTINGS = DISTRIBUTIONS | {"house": HOUSE}
"""Everything that a plan can be named after, as "office:house:17": the offices, and houses."""
