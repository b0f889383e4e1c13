"""The bike's other numbers: wheel, pulses, cadence, and the torque gain by a climb."""
