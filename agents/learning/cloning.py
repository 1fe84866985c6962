"""Behaviour cloning: a policy and its value function learn from demonstrations."""

from __future__ import annotations

from typing import TYPE_CHECKING

import torch

from semnav_env.agents.learning.imitation import Tensors

if TYPE_CHECKING:
    from stable_baselines3 import PPO

EPOCHS, BATCH_SIZE, LEARNING_RATE = 25, 512, 2e-3
"""Passes over the demonstrations, decisions in a gradient step, and the largest step size."""

HUBER_BETA = 0.2
"""Error of an action beyond which the loss grows linearly: a planner's choices are discrete."""

VALUE_WEIGHT = 0.01
"""Weight of the squared error of the value beside the error of the actions."""


def clone(model: PPO, demonstrations: Tensors, seed: int) -> None:
    """Teach the mean of the policy the actions, and the value function the returns.

    Args:
        model: whose weights are changed.
        demonstrations: "observations", "actions" and "returns", a row for each decision.
        seed: of the order of the decisions.
    """
    observations, actions, returns = (
        torch.from_numpy(demonstrations[name]) for name in ("observations", "actions", "returns")
    )
    count = len(observations)
    batches = max(1, count // BATCH_SIZE)
    policy, order = model.policy, torch.Generator().manual_seed(seed)
    optimizer = torch.optim.Adam(policy.parameters(), LEARNING_RATE)
    schedule = torch.optim.lr_scheduler.OneCycleLR(
        optimizer, LEARNING_RATE, total_steps=EPOCHS * batches
    )
    for _ in range(EPOCHS):
        for rows in torch.randperm(count, generator=order).chunk(batches):
            hidden, hidden_value = policy.mlp_extractor(observations[rows])
            wanted, values = policy.action_net(hidden), policy.value_net(hidden_value).flatten()
            loss = torch.nn.functional.smooth_l1_loss(wanted, actions[rows], beta=HUBER_BETA)
            loss += VALUE_WEIGHT * torch.nn.functional.mse_loss(values, returns[rows])
            optimizer.zero_grad()
            torch.autograd.backward(loss)
            optimizer.step()
            schedule.step()
