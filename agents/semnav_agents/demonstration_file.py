"""Minari datasets of demonstrations: compressed, with the specification of the environment."""

from __future__ import annotations

import re
import uuid
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from gymnasium.envs.registration import EnvSpec

from semnav_agents.demonstrations import Demonstration
from semnav_env.env import SemNavEnv
from semnav_features.interruption import uninterrupted
from semnav_features.sole_writer import sole_writer
from semnav_features.writing import discard, naming, put_in_place

if TYPE_CHECKING:  # an extra
    from minari.dataset.minari_storage import MinariStorage

DATASET_NAME = re.compile(r"(?:[-_\w]+/)*[-_\w]+-v\d+")
"""The form of a dataset's name in Minari, such as "semnav/train-scripted-v0"."""

COMPRESSION = {"compression": "gzip", "compression_opts": 4, "shuffle": True}
"""How each array of an episode is stored. Bytes of equal weight are stored together, so that the
many zeros of unused rows, and the exponents of ranges, take little space."""

RESOLUTION = 2.0**-10
"""Step of rounded observations, metres, radians, m/s and so on: about the millimetre in which a
TiM561 gives its ranges, and exact in binary, so that the last bits are zeros."""


class DemonstrationFile:
    """A new Minari dataset; each demonstration is written at once.

    It is a context manager. Until its end the dataset is in a folder beside the target, whose name
    ends in `.part`, because a kill or a full disk may leave an HDF5 file that cannot be read. The
    end may also be an error or an interruption between two demonstrations; the error then gets a
    note that says where those so far are. Without any demonstration nothing is kept of it.

    Attributes:
        folder: of the dataset, absolute.

    Args:
        out: a name such as "semnav/train-scripted-v0", by which Minari finds it, or a folder.
        env: the environment that was shown, which gives spaces and specification.
        agent: name of the agent, for the description of the dataset.
        rounds: round observations to `RESOLUTION`, which takes far less room; otherwise every bit
            is kept.

    Raises:
        ImportError: Minari is not installed; the error names the extra.
        FileExistsError: there is already a dataset of that name, or something in that folder.
        BlockingIOError: another run is writing it.
    """

    folder: Path

    def __init__(self, out: str, env: SemNavEnv, agent: str, rounds: bool = False) -> None:
        try:
            import h5py  # noqa: F401 - Minari fails late without it
            from minari.storage import get_dataset_path
        except ImportError:
            raise ImportError(
                'demonstrations are kept by minari and h5py: pip install "semnav-env[data]"'
            ) from None
        named = DATASET_NAME.fullmatch(out) is not None
        self.folder = Path(get_dataset_path(out) if named else out).absolute()
        if self.folder.exists() and (not self.folder.is_dir() or any(self.folder.iterdir())):
            raise FileExistsError(
                17, "there is something already; give another name or folder", str(self.folder)
            )
        self._part = self.folder.with_name(f".{self.folder.name}-{uuid.uuid4().hex[:12]}.part")
        self._env, self._agent, self._rounds = env, agent, rounds
        self._name = out if named else f"semnav/{agent_word(agent)}-v0"
        self._added, self._whole = 0, True
        self._lock = ExitStack()

    def __enter__(self) -> Self:
        """The dataset, empty."""
        try:
            with naming(self.folder):
                self.folder.parent.mkdir(parents=True, exist_ok=True)
                self._lock.enter_context(sole_writer(self.folder))
                self._storage = self._made()
        except BaseException:
            with self._lock:
                discard(self._part, self.folder)
            raise
        return self

    def _made(self) -> MinariStorage:
        import minari
        from minari.dataset.minari_storage import MinariStorage

        data, env, agent = self._part / "data", self._env, self._agent
        data.mkdir(parents=True)
        spaces = env.observation_space, env.action_space
        storage = MinariStorage.new(data, *spaces, _in_json(env.spec))
        storage.update_metadata(
            {
                "dataset_id": self._name,
                "minari_version": minari.__version__,
                "algorithm_name": agent,
                "description": f"{agent} on {env.robot.name} in frozen episodes of semnav-env",
            }
        )
        return storage

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Put the dataset in its place."""
        with uninterrupted(), self._lock:
            if error is not None and not self._added:
                discard(self._part, self.folder)
            elif self._whole:
                put_in_place(self._part, self.folder)
        if error is not None and self._added:
            where = self.folder if self._whole else self._part
            error.add_note(f"'{where}' holds {self._added} demonstrations so far")

    def add(self, demonstration: Demonstration) -> None:
        """Write a demonstration; an interruption waits until it is complete."""
        from minari.data_collector.episode_buffer import EpisodeBuffer

        episode, seen = demonstration.episode, demonstration.observations
        buffer = EpisodeBuffer(
            id=self._added,
            seed=episode.number,
            options={
                "episode": episode.id,
                "command": episode.readings[0],
                "instruction": episode.command,
                "language": episode.language,
                "floor_plan": episode.floor_plan,
                "success": demonstration.success,
            },
            observations=_rounded(seen) if self._rounds else seen,
            actions=demonstration.actions,
            rewards=demonstration.rewards,
            terminations=demonstration.terminations,
            truncations=demonstration.truncations,
            infos=demonstration.infos,
        )
        arrays = {name: getattr(buffer, name) for name in _ARRAYS}
        self._whole = False
        with uninterrupted(), naming(self.folder):
            self._make_room(arrays)
            self._storage.update_episodes([buffer])
            self._added += 1
            self._whole = True

    def _make_room(self, arrays: dict[str, Any]) -> None:
        """Make the empty, compressed arrays of an episode, to which Minari appends the values."""
        import h5py

        with h5py.File(self._part / "data" / "main_data.hdf5", "a", track_order=True) as file:
            for path, values in _leaves(arrays, f"episode_{self._added}"):
                shape = values.shape[1:]
                file.create_dataset(
                    path,
                    (0, *shape),
                    values.dtype,
                    maxshape=(None, *shape),
                    chunks=values.shape,
                    **COMPRESSION,
                )

    @property
    def count(self) -> int:
        """Number of demonstrations in the complete dataset, counted there."""
        import h5py

        with h5py.File(self.folder / "data" / "main_data.hdf5", "r") as file:
            return len(file)


_ARRAYS = ("observations", "actions", "rewards", "terminations", "truncations", "infos")


def _leaves(arrays: dict[str, Any], path: str) -> Iterator[tuple[str, np.ndarray]]:
    """The arrays of nested dictionaries, with their places in the file."""
    for name, value in arrays.items():
        inner = f"{path}/{name}"
        if isinstance(value, dict):
            yield from _leaves(value, inner)
        else:
            yield inner, np.asarray(value)


def _rounded(observations: dict[str, Any]) -> dict[str, Any]:
    """Observations with every float a multiple of `RESOLUTION`."""
    return {
        name: (np.rint(value / RESOLUTION) * RESOLUTION).astype(value.dtype)
        if value.dtype.kind == "f"
        else value
        for name, value in observations.items()
    }


def _in_json(spec: EnvSpec | None) -> EnvSpec | None:
    """A specification if it can be kept as JSON; one with objects of the user's own cannot."""
    try:
        return spec if spec is not None and spec.to_json() else None
    except (TypeError, ValueError):
        return None


def agent_word(agent: str) -> str:
    """The name of an agent, without characters that the name of a dataset cannot have."""
    return re.sub(r"[^-_\w]+", "_", Path(agent).name) or "agent"
