"""Learning of the grounding network from samples."""

from __future__ import annotations

from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor, nn

from semnav_agents.hearing.mirror import Arrays, mirrored
from semnav_agents.hearing.network import KINDS
from semnav_agents.hearing.torch_network import Grounded, TorchGrounding
from semnav_agents.networks.adam import adam_moments, adam_shapes, adam_tensors
from semnav_env.networks.weights import check_tensors

PLACE_SCALE, HEADING_SHARPNESS = 0.25, 8.0
"""Scale of the Laplace distribution of places, metres; concentration of that of headings."""

SAME_DOOR = 0.5
"""Middles of the same door are nearer to each other than this, metres."""


def to_tensors(samples: Arrays) -> dict[str, Tensor]:
    """A batch as tensors, cut to the elements that it has."""
    n = int(samples["count"].max())
    labels = samples["labels"]
    tensors = {
        "elements": samples["elements"][:, :n].astype(np.float32),
        "mask": np.arange(n) < samples["count"][:, None],
        "command": samples["command"].astype(np.float32),
        "bases": samples["bases"][:, :n],
        "robot": samples["robot"],
        "door": _door_element(samples["jambs"][:, :n], labels),
    } | {f"label_{name}": labels[name].astype(_LABEL_TYPES[name]) for name in _LABEL_TYPES}
    return {name: torch.from_numpy(np.ascontiguousarray(value)) for name, value in tensors.items()}


_LABEL_TYPES: dict[str, Any] = {
    "kind": np.int64,
    "has_goal": np.bool_,
    "has_door": np.float32,
    "has_next": np.bool_,
    "advance": np.int64,
    "pose": np.float32,
    "next": np.float32,
}


def _door_element(jambs: NDArray[Any], labels: NDArray[Any]) -> NDArray[np.int64]:
    """Index of the element that is the door of the goal; -1 without a door."""
    doors = jambs.any(axis=2)
    middles, wanted = (jambs[..., :2] + jambs[..., 2:]) / 2, labels["door"]
    apart = np.hypot(*np.moveaxis(middles - ((wanted[:, :2] + wanted[:, 2:]) / 2)[:, None], 2, 0))
    apart = np.where(doors, apart, np.inf)
    nearest = apart.argmin(axis=1)
    found = (apart.min(axis=1) < SAME_DOOR) & labels["has_door"] & labels["has_goal"]
    result: NDArray[np.int64] = np.where(found, nearest, -1)
    return result


def loss_of(said: Grounded, batch: dict[str, Tensor]) -> Tensor:
    """The loss of a batch: of proposals, kind, door, begin of the next clause, and advance."""
    goal = batch["label_has_goal"]
    apart = torch.linalg.vector_norm(said.places - batch["label_pose"][:, None, :2], dim=2)
    heading = batch["label_pose"][:, 2]
    turned = said.headings @ torch.stack((heading.cos(), heading.sin()), dim=1)[:, :, None]
    fits = -apart / PLACE_SCALE + HEADING_SHARPNESS * (turned[..., 0] - 1.0)
    mixed = -torch.logsumexp(said.log_shares + fits, dim=1)
    door = batch["door"]
    pointed = -said.log_shares.gather(1, door.clamp(min=0)[:, None])[:, 0] * (door >= 0)
    kind = nn.functional.cross_entropy(
        said.outputs[:, :KINDS], batch["label_kind"], reduction="none"
    )
    has_door = nn.functional.binary_cross_entropy_with_logits(
        said.outputs[:, KINDS], batch["label_has_door"], reduction="none"
    )
    following = (said.outputs[:, KINDS + 1] - batch["label_next"][:, 0]).abs()
    following = following * batch["label_has_next"]
    advance = nn.functional.cross_entropy(
        said.advances, batch["label_advance"], ignore_index=-1, reduction="none"
    )
    of_goal = mixed.clamp(max=60.0) + pointed + kind + has_door + following
    return (of_goal * goal).mean() + ADVANCE_WEIGHT * advance.mean()


ADVANCE_WEIGHT = 3.0
"""Going on too early or too late costs an episode, and few samples show it."""


WEIGHT_DECAY, MOST_GRADIENT = 0.01, 1.0
"""Of AdamW; and the norm to which gradients are cut."""

ADAM_PREFIX = "adam."
"""First part of the names of Adam's tensors."""

POOLED = 16
"""Batches that are drawn at once and sorted by their number of elements."""


class Learner:
    """A network under training, with AdamW (Loshchilov and Hutter 2019).

    Args:
        network: in torch.
    """

    def __init__(self, network: TorchGrounding) -> None:
        self.network = network
        self.optimizer = torch.optim.AdamW(network.parameters(), weight_decay=WEIGHT_DECAY)

    def epoch(
        self, samples: Arrays, size: int, rates: tuple[float, float], rng: np.random.Generator
    ) -> float:
        """One pass, each batch as it is or mirrored; returns the mean loss.

        Args:
            samples: to learn from.
            size: of a batch.
            rates: step size at the beginning and at the end.
            rng: of the order and the mirror.
        """
        parts = batches(samples["count"], size, rng)
        losses = []
        for k, part in enumerate(parts):
            share = k / len(parts)
            for group in self.optimizer.param_groups:
                group["lr"] = rates[0] * (1.0 - share) + rates[1] * share
            batch = {name: values[np.sort(part)] for name, values in samples.items()}
            losses.append(self._step(mirrored(batch) if rng.random() < 0.5 else batch))
        return float(np.mean(losses))

    def _step(self, batch: Arrays) -> float:
        tensors = to_tensors(batch)
        loss = loss_of(ask(self.network, tensors), tensors)
        self.optimizer.zero_grad(set_to_none=True)
        loss.backward()  # type: ignore[no-untyped-call]
        nn.utils.clip_grad_norm_(self.network.parameters(), MOST_GRADIENT)
        self.optimizer.step()
        return float(loss.detach())

    def state(self) -> Arrays:
        """Weights and the state of the optimizer, by name."""
        return self.network.arrays() | adam_tensors(
            ADAM_PREFIX, self.optimizer.state_dict()["state"]
        )

    def load(self, tensors: Arrays) -> None:
        """Continue from a result of `state`.

        Raises:
            ValueError: a tensor is missing, too many, of another shape or type, or not finite.
        """
        shapes, weights = self.network.shape.tensors(), list(self.network.parameters())
        shapes |= adam_shapes(ADAM_PREFIX, {i: tuple(w.shape) for i, w in enumerate(weights)})
        check_tensors(tensors, shapes)
        self.network.load(tensors)
        values = {name: torch.from_numpy(value.copy()) for name, value in tensors.items()}
        moments = adam_moments(ADAM_PREFIX, values, range(len(weights)))
        groups = self.optimizer.state_dict()["param_groups"]
        self.optimizer.load_state_dict({"state": moments, "param_groups": groups})


def batches(
    counts: NDArray[np.int8], size: int, rng: np.random.Generator
) -> list[NDArray[np.int64]]:
    """Random batches of sample indices; samples of a batch have similar numbers of elements.

    Batches of samples of similar size waste little computation on unused rows.
    """
    order = rng.permutation(len(counts))
    pools = np.array_split(order, max(1, len(order) // (POOLED * size)))
    parts = [
        part
        for pool in pools
        for part in np.array_split(
            pool[np.argsort(counts[pool], kind="stable")], max(1, len(pool) // size)
        )
    ]
    return [parts[k] for k in rng.permutation(len(parts))]


def ask(network: TorchGrounding, batch: dict[str, Tensor]) -> Grounded:
    """The output of the network for a batch."""
    names = ("elements", "mask", "command", "bases", "robot")
    said: Grounded = network(*(batch[name] for name in names))
    return said


@torch.no_grad()
def measured(network: TorchGrounding, samples: Arrays) -> dict[str, float]:
    """Accuracy of the network on samples: shares, and the median error of places in metres."""
    batch = to_tensors(samples)
    said = ask(network, batch)
    goal, rows = batch["label_has_goal"], torch.arange(len(batch["robot"]))
    best = said.log_shares.argmax(dim=1)
    apart = torch.linalg.vector_norm(said.places[rows, best] - batch["label_pose"][:, :2], dim=1)
    kind = said.outputs[:, :KINDS].argmax(dim=1) == batch["label_kind"]
    door, advance = batch["door"], batch["label_advance"]
    known, chosen = advance >= 0, said.advances.argmax(dim=1)
    return {
        "kind": float(kind[goal].float().mean()),
        "place": float((apart[goal] < SAME_DOOR).float().mean()),
        "median_error": float(apart[goal].median()),
        "door": float((best == door)[(door >= 0) & goal].float().mean()),
        "advance": float((chosen == advance)[known & (advance > 0)].float().mean()),
        "stay": float((chosen == advance)[known & (advance == 0)].float().mean()),
    }
