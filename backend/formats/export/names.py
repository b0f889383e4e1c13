"""What a ride's channels are called in a file: torque that was only asked for is named so."""

from __future__ import annotations

from backend.core.energy import DEMANDED, MOTOR_TORQUE, MOTOR_TORQUE_DEMANDED
from backend.core.ride import Ride


def export_names(ride: Ride) -> dict[str, str]:
    """The name in a file of every recorded channel."""
    renamed = {MOTOR_TORQUE: MOTOR_TORQUE_DEMANDED} if ride.motor_torque_meaning == DEMANDED else {}
    return {channel.name: renamed.get(channel.name, channel.name) for channel in ride.channels}
