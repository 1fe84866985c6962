"""Ray on this machine or a cluster, and kernels that are compiled once on each of its machines."""

from __future__ import annotations

import os
import socket
from dataclasses import replace
from typing import Any

from semnav_agents.learning.presets import Preset
from semnav_agents.learning.rllib.options import RayOptions
from semnav_agents.learning.rllib.runner_env import runner_envs

LOOPBACK = "127.0.0.1"
"""Address of a Ray that is started here: no other machine reaches it."""

LOCAL_SWITCHES = {"RAY_USAGE_STATS_ENABLED": "0", "RAY_ENABLE_WINDOWS_OR_OSX_CLUSTER": "0"}
"""Environment variables that Ray reads when it is imported. It reports no usage; and, as it does by
itself on Windows and macOS, a Ray that is started here takes the loopback address."""

CACHE_VARIABLE = "SEMNAV_CACHE_DIR"
"""Environment variable with the folder of compiled kernels, which runners take over."""


CONNECT_SECONDS = 10.0
"""Time that the first machine of a cluster has to answer, seconds."""


def connect(options: RayOptions) -> None:
    """Start Ray on this machine, or join the cluster at an address.

    Raises:
        ValueError: not an address, or there are fewer cores than the runners reserve.
        RuntimeError: Ray would have listened beyond this machine.
        ConnectionError: there is no cluster at the address.
    """
    _join(options.address)
    import ray

    cores, wanted = int(ray.cluster_resources().get("CPU", 0)), options.runners * options.threads
    if cores < wanted:
        ray.shutdown()
        raise ValueError(
            f"{options.runners} runners of {options.threads} threads need {wanted} cores, and Ray "
            f"has {cores}: give fewer --ray.runners, or start more machines first"
        )


def _join(address: str | None) -> None:
    if address is None:
        os.environ.update(LOCAL_SWITCHES)
    elif address != "auto":
        check_reachable(address)
    import ray

    folder = os.environ.get(CACHE_VARIABLE)
    settings: dict[str, Any] = {"logging_level": "ERROR", "log_to_driver": False}
    if folder:
        settings["runtime_env"] = {"env_vars": {CACHE_VARIABLE: folder}}
    if address is not None:
        ray.init(address, **settings)
        return
    ray.init("local", include_dashboard=False, _node_ip_address=LOOPBACK, **settings)
    found = ray.util.get_node_ip_address()
    if found != LOOPBACK:
        ray.shutdown()
        raise RuntimeError(
            f"Ray took the address {found}, not {LOOPBACK}: it was imported before "
            f"{' and '.join(LOCAL_SWITCHES)} were set to 0"
        )


def check_reachable(address: str) -> None:
    """Refuse an address where nothing answers; Ray itself would wait for minutes.

    Raises:
        ValueError: it is not HOST:PORT.
        ConnectionError: nothing answers there.
    """
    host, _, port = address.rpartition(":")
    if not host or "/" in host or not port.isdigit():
        raise ValueError(f"--ray.address is {address!r:.80}; it must be HOST:PORT or auto")
    try:
        socket.create_connection((host.strip("[]"), int(port)), CONNECT_SECONDS).close()
    except (OSError, OverflowError) as error:
        raise ConnectionError(f"no Ray cluster answers at {address}: {error}") from None


def warm_nodes(preset: Preset) -> None:
    """Compile the kernels of a preset once on each machine, before many runners do so at once.

    The first machine compiles alone: if the machines share a folder, the others find its kernels.
    """
    import ray
    from ray.util.scheduling_strategies import NodeAffinitySchedulingStrategy

    nodes = [node["NodeID"] for node in ray.nodes() if node["Alive"] and "CPU" in node["Resources"]]
    warm = ray.remote(warm_kernels)
    tasks = [
        warm.options(scheduling_strategy=NodeAffinitySchedulingStrategy(node, soft=False)).remote
        for node in nodes
    ]
    ray.get(tasks[0](preset))
    ray.get([task(preset) for task in tasks[1:]])


def warm_kernels(preset: Preset) -> None:
    """Compile, or load, the kernels that robots of a preset need."""
    envs = runner_envs(replace(preset, max_seconds=1.0), 1)
    envs.reset(seed=0)
    for _ in range(20):  # some episodes from their beginning to their end
        envs.step(envs.action_space.sample())
    envs.close()
