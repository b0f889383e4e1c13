"""The rest of the bike's numbers: wheel, pulses, cadence, and the torque gain from a ride."""
