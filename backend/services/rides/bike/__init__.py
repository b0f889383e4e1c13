"""The bike's numbers from its rides: its wheel, and the torque gain by an energy balance."""
