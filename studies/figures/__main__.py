"""`python -m studies.figures`: draws a picture of the documentation, or prints its numbers."""

import tyro

from studies.figures import (
    approach,
    architecture,
    arcs,
    buildings,
    clouds,
    drift,
    drift_success,
    features_tables,
    language,
    leaderboard,
    lines,
    listener,
    logs,
    mapping,
    observation_table,
    offices,
    real_floor,
    routes,
    rules,
    rules_table,
    situations,
    speed,
    tour,
)

FIGURES = (
    *(
        approach,
        architecture,
        arcs,
        buildings,
        clouds,
        drift,
        drift_success,
        features_tables,
        language,
        leaderboard,
        lines,
        listener,
        logs,
        mapping,
    ),
    *(observation_table, offices, real_floor, routes, rules, rules_table, situations, speed, tour),
)

if __name__ == "__main__":
    names = {module.__name__.rpartition(".")[2]: module.main for module in FIGURES}
    tyro.extras.subcommand_cli_from_dict(
        names, prog="python -m studies.figures", config=(tyro.conf.PositionalRequiredArgs,)
    )
