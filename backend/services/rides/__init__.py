"""Rides: recorded while a bike is ridden, shown and replayed afterwards."""
