#!/usr/bin/env python3
"""Means of light that goes between two unit squares at a right angle, by quadrature in Python alone.

The floor is 0 < x, y < 1 at z = 0, the wall 0 < y, z < 1 at x = 1. Prints the constants of renderer/integrators/tilted_floor_test.cpp:
  view_factor  mean over the wall of (1/pi) int over the floor of cos cos / d^2   (Hamilton and Morgan 1952: 0.20004)
  sideways     mean over the floor of (1/pi) int over the wall of cos_wall (i . x) / d^2, with i from floor to wall
A floor whose shading normal leans by a towards the wall gathers view_factor cos a + sideways sin a from it.
"""
import math


def nodes(n):
    """Gauss-Legendre on (0, 1)."""
    points = []
    for i in range(n):
        x = math.cos(math.pi * (i + 0.75) / (n + 0.5))
        for _ in range(100):
            p0, p1 = 1.0, x
            for k in range(2, n + 1):
                p0, p1 = p1, ((2 * k - 1) * x * p1 - (k - 1) * p0) / k
            slope = n * (x * p1 - p0) / (x * x - 1)
            step = p1 / slope
            x -= step
            if abs(step) < 1e-15:
                break
        points.append(((x + 1) / 2, 1 / ((1 - x * x) * slope * slope)))
    return points


def patch(ax, by, az, n):
    """Lambert's vector irradiance (1/pi units of radiance) at a point of the floor, a = 1 - x from the wall's foot, from
    the wall's part 0 < y < 1, 0 < z < 1: sum over edges of angle times unit normal of the cone's side, over 2 pi."""
    x, y = ax, by
    corners = [(1 - x, 0 - y, 0.0), (1 - x, 1 - y, 0.0), (1 - x, 1 - y, 1.0), (1 - x, 0 - y, 1.0)]
    total = [0.0, 0.0, 0.0]
    for k in range(4):
        p, q = corners[k], corners[(k + 1) % 4]
        c = (p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0])
        norm = math.sqrt(sum(v * v for v in c))
        d = sum(u * v for u, v in zip(p, q))
        angle = math.atan2(norm, d)
        for i in range(3):
            total[i] += angle * c[i] / norm / (2 * math.pi)
    if total[0] < 0:
        total = [-v for v in total]
    return total


def main():
    n = 64
    line = nodes(n)
    up = sideways = 0.0
    for u, wu in line:
        # x = 1 - u^3 puts more points near the common edge
        x, jacobian = 1 - u ** 3, 3 * u * u
        for y, wy in line:
            v = patch(x, y, 0, n)
            sideways += wu * wy * jacobian * v[0]
            up += wu * wy * jacobian * v[2]
    a = 1.0
    h = (2 * math.atan(1 / a) - math.sqrt(2) * math.atan(1 / math.sqrt(2)) + 0.25 * math.log(0.75)) / math.pi
    print(f"view_factor {up:.6f} (Hamilton and Morgan's formula {h:.6f})")
    print(f"sideways    {sideways:.6f}")


if __name__ == "__main__":
    main()
