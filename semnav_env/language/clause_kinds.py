"""All clauses of this package."""

from __future__ import annotations

from semnav_env.language import clauses, finding_clauses
from semnav_env.language.clauses import Clause

CLAUSE_KINDS: dict[str, type[Clause]] = {
    kind.__name__: kind
    for kind in (
        *(clauses.Follow, clauses.Turn, clauses.GoToDoor, clauses.GoToRoom, clauses.Leave),
        *(clauses.GoBack, clauses.BackUp, finding_clauses.SearchHouse, clauses.Stop, clauses.Pace),
        *(clauses.Face, clauses.IfThere, finding_clauses.SearchRoom, finding_clauses.LookAround),
        *(finding_clauses.CallOut, finding_clauses.GoToPerson, finding_clauses.AskName),
    )
}
"""The clauses by their names."""
