"""The rival's side of the simulator's benchmark: the pinned bike W1 in numpy and scipy.

The same equation (thesis_checks I-11), motor limits, one-way motor clutch, battery and fixed law as
the simulator's start scenario: integrated by scipy's solve_ivp between control steps, and by an
explicit step of 1 ms in plain numpy. Runs in an environment of its own and prints one JSON object:
seconds simulated in a second, and the speed after 20 s, so that both sides are known to compute the
same thing. Usage: python rivals_plant.py
"""

import json
import time

import numpy as np
from scipy.integrate import solve_ivp

MASS_KG, WHEELS_KG_M2, RADIUS_M = 100.0, 0.24, 0.33
ROLLING_N = 0.00864 * 100 * 9.80665
DRAG = 0.5 * 1.2 * 0.40
GEAR, CHAIN, GEAR_EFFICIENCY, CHAIN_EFFICIENCY = 40.34, 44 / 14, 0.92, 0.97
MOTOR_KG_M2, CRANK_KG_M2 = 1.4e-4, 0.02
K, RESISTANCE, FRICTION = 0.112, 0.25, 1.2e-4
RIDER_NM = 24.48
CONTROL_S, STEP_S = 0.01, 0.001
SECONDS = 20.0


def motor_nm(demand_nm: float, motor_rad_s: float, voltage_v: float) -> float:
    power_w = min(432.0, 12.0 * voltage_v)
    k2 = K * K
    root = np.sqrt(motor_rad_s**2 + 4 * RESISTANCE * power_w / k2)
    limit = min(k2 * (root - motor_rad_s) / (2 * RESISTANCE),
                K * (voltage_v - K * motor_rad_s) / RESISTANCE)  # fmt: skip
    wanted = min(demand_nm, 2.0) + FRICTION * motor_rad_s
    return max(min(wanted, limit), 0.0) - FRICTION * motor_rad_s


def acceleration_ms2(speed_ms: float, demand_nm: float, voltage_v: float) -> float:
    motor_rad_s = speed_ms / RADIUS_M / CHAIN * GEAR
    shaft_nm = motor_nm(demand_nm, motor_rad_s, voltage_v) if demand_nm > 0 else 0.0
    crank_nm = RIDER_NM + GEAR_EFFICIENCY * GEAR * shaft_nm
    drive_n = CHAIN_EFFICIENCY * crank_nm / CHAIN / RADIUS_M
    turning = WHEELS_KG_M2 + CHAIN_EFFICIENCY * CRANK_KG_M2 / CHAIN**2
    if demand_nm > 0:
        turning += CHAIN_EFFICIENCY * GEAR_EFFICIENCY * MOTOR_KG_M2 * (GEAR / CHAIN) ** 2
    moving_kg = MASS_KG + turning / RADIUS_M**2
    return (drive_n - ROLLING_N - DRAG * speed_ms * abs(speed_ms)) / moving_kg


def battery_v(power_w: float) -> float:
    open_v = 40.6
    return open_v - (open_v - np.sqrt(open_v**2 - 4 * 0.12 * power_w)) / 2


def law_nm(filtered_nm: float, speed_ms: float) -> float:
    ratio = min(1.0, max(0.0, (24.0 - 3.6 * speed_ms) / 9.0))
    return ratio * filtered_nm / GEAR


def ride(integrate) -> float:
    speed_ms, filtered_nm, voltage_v = 0.0, 0.0, 40.6
    for _ in range(round(SECONDS / CONTROL_S)):
        filtered_nm += (RIDER_NM - filtered_nm) * CONTROL_S / (0.5 + CONTROL_S)
        demand_nm = law_nm(filtered_nm, speed_ms)
        speed_ms = integrate(speed_ms, demand_nm, voltage_v)
        motor_rad_s = speed_ms / RADIUS_M / CHAIN * GEAR
        current_a = (demand_nm + FRICTION * motor_rad_s) / K
        voltage_v = battery_v(current_a * K * motor_rad_s + current_a**2 * RESISTANCE)
    return 3.6 * speed_ms


def by_solve_ivp(speed_ms: float, demand_nm: float, voltage_v: float) -> float:
    solved = solve_ivp(
        lambda _, y: [acceleration_ms2(y[0], demand_nm, voltage_v)],
        (0.0, CONTROL_S),
        [speed_ms],
        max_step=STEP_S,
    )
    return float(solved.y[0, -1])


def by_steps(speed_ms: float, demand_nm: float, voltage_v: float) -> float:
    for _ in range(round(CONTROL_S / STEP_S)):
        speed_ms += STEP_S * acceleration_ms2(speed_ms, demand_nm, voltage_v)
    return speed_ms


def main() -> None:
    results = {}
    for name, integrate in (("solve_ivp", by_solve_ivp), ("numpy_steps", by_steps)):
        start = time.process_time()
        speed_kmh = ride(integrate)
        factor = SECONDS / (time.process_time() - start)
        results[name] = {"times_real_time": factor, "speed_kmh": speed_kmh}
    print(json.dumps(results))


if __name__ == "__main__":
    main()
