#!/usr/bin/env python3
"""Renders the radiance field of mitsuba_ellipsoid_scenes.py by its definition, in numpy, and compares photonproof's.

    PYTHON harness/oracles/radiance_field.py PROGRAM [-o FOLDER] [--samples N] [--mitsuba]

Every ray meets all 25 Gaussians in double precision and sorts them by where it enters their ellipsoids, so there is no
traversal that could lose one. --mitsuba holds Mitsuba against the same images. Each line has the ratio of the means of
red, green and blue to numpy's with the standard error of the latter, and the block of 8 x 8 pixels that is most standard
errors off. Ends with 1 where photonproof is more than 4.5 of them off.
"""
import argparse
import math
import subprocess
import sys
from pathlib import Path

import numpy as np

import mitsuba_ellipsoid_scenes as scenes
from mitsuba_scene_parts import integer

WIDTH, HEIGHT, BLOCK = 64, 48, 8
ORIGIN, TARGET, FOV = np.array([0.5, 1.2, 5]), np.array([0, 0.3, 0]), 40
FLOOR, FLOOR_HALF, EXTENT = -0.5, 3, 3
CASES = [("max_depth 64", "", 64), ("max_depth 2", integer("max_depth", 2), 2)]


def cloud_of(path):
    """Centres, rows of the turned axes over their scales, opacities, harmonics [25, 3, 16]."""
    data = path.read_bytes()
    rows = np.frombuffer(data[data.index(b"end_header\n") + 11:], dtype="<f4").reshape(-1, 62).astype(float)
    quaternion = rows[:, 58:62] / np.linalg.norm(rows[:, 58:62], axis=1)[:, None]
    w, x, y, z = quaternion.T
    axes = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)],
                     [2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)],
                     [2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)]]).transpose(2, 0, 1)
    harmonics = np.concatenate([rows[:, 6:9, None], rows[:, 9:54].reshape(-1, 3, 15)], axis=2)
    return rows[:, :3], axes / np.exp(rows[:, 55:58])[:, :, None], 1 / (1 + np.exp(-rows[:, 54])), harmonics


def basis(directions):
    """The 16 real spherical harmonics up to degree 3, with the signs of 3D Gaussian splatting."""
    x, y, z = directions.T
    return np.stack([
        np.full_like(x, 0.28209479177387814), -0.4886025119029199 * y, 0.4886025119029199 * z, -0.4886025119029199 * x,
        1.0925484305920792 * x * y, -1.0925484305920792 * y * z, 0.31539156525252005 * (2 * z * z - x * x - y * y),
        -1.0925484305920792 * x * z, 0.5462742152960396 * (x * x - y * y), -0.5900435899266435 * y * (3 * x * x - y * y),
        2.890611442640554 * x * y * z, -0.4570457994644658 * y * (4 * z * z - x * x - y * y),
        0.3731763325901154 * z * (2 * z * z - 3 * x * x - 3 * y * y), -0.4570457994644658 * x * (4 * z * z - x * x - y * y),
        1.445305721320277 * z * (x * x - y * y), -0.5900435899266435 * x * (x * x - 3 * y * y)], axis=-1)


def camera_rays(random):
    forward = (TARGET - ORIGIN) / np.linalg.norm(TARGET - ORIGIN)
    left = np.cross([0, 1, 0], forward)
    left /= np.linalg.norm(left)
    half = math.tan(math.radians(FOV / 2))
    x = half * (1 - 2 * (np.arange(WIDTH) + random.random((HEIGHT, WIDTH))) / WIDTH)
    y = half * (HEIGHT - 2 * (np.arange(HEIGHT)[:, None] + random.random((HEIGHT, WIDTH)))) / WIDTH
    rays = (forward + x[..., None] * left + y[..., None] * np.cross(forward, left)).reshape(-1, 3)
    return rays / np.linalg.norm(rays, axis=1)[:, None]


def blended(rays, cloud, most):
    centres, to_unit, opacities, harmonics = cloud
    origin = np.einsum("nij,nj->ni", to_unit, ORIGIN - centres)
    along = np.einsum("nij,rj->rni", to_unit, rays)
    squared = (along**2).sum(-1)
    middle = -(origin * along).sum(-1) / squared
    distance2 = ((origin + along * middle[..., None])**2).sum(-1)
    within = EXTENT**2 - distance2
    enters = np.where((within > 0) & (middle > 0), middle - np.sqrt(np.maximum(within, 0) / squared), np.inf)
    enters[enters < 0] = np.inf  # its ray begins inside
    floor = np.where(rays[:, 1] < 0, (FLOOR - ORIGIN[1]) / np.minimum(rays[:, 1], -1e-9), np.inf)
    on_floor = (np.abs(ORIGIN + rays * np.where(np.isfinite(floor), floor, 0)[:, None])[:, [0, 2]] <= FLOOR_HALF).all(1)
    floor[~on_floor] = np.inf
    weights = np.minimum(opacities * np.exp(-distance2 / 2), 0.9999)
    colours = np.maximum(0.5 + np.einsum("nck,rk->rnc", harmonics, basis(rays)), 0)
    order, every = np.argsort(enters, 1), np.arange(len(rays))
    seen, image, goes_on = np.ones(len(rays)), np.zeros((len(rays), 3)), np.ones(len(rays), bool)
    for which in order[:, :most].T:
        goes_on &= enters[every, which] < floor
        weight = np.where(goes_on, weights[every, which], 0)
        image += (seen * weight)[:, None] * colours[every, which]
        seen *= 1 - weight
        goes_on &= seen > 0.01
    return np.where(image <= 0.04045, image / 12.92, ((image + 0.055) / 1.055)**2.4)


def by_numpy(cloud, most, samples):
    """Mean and variance of the mean."""
    random, total, squares = np.random.default_rng(1), 0, 0
    for _ in range(samples):
        image = blended(camera_rays(random), cloud, most).reshape(HEIGHT, WIDTH, 3)
        total, squares = total + image, squares + image**2
    mean = total / samples
    return mean, (squares / samples - mean**2) / samples


def by_photonproof(program, scene, samples):
    image = scene.with_suffix(".pfm")
    subprocess.run([program, "render", scene, "-o", image, "--spp", str(16 * samples), "--quiet"], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    data = image.read_bytes()
    return np.frombuffer(data[-12 * WIDTH * HEIGHT:], "<f4").reshape(HEIGHT, WIDTH, 3)[::-1].astype(float)


def by_mitsuba(scene, samples):
    import mitsuba
    mitsuba.set_variant("llvm_ad_rgb")
    loaded = mitsuba.load_file(str(scene))
    return np.mean([np.array(mitsuba.render(loaded, spp=samples, seed=seed))[..., :3].astype(float) for seed in range(4)], 0)


def blocks(image):
    return image.reshape(HEIGHT // BLOCK, BLOCK, WIDTH // BLOCK, BLOCK, 3).mean((1, 3))


def judge(name, image, mean, variance, noise):
    """Prints a line; the largest number of standard errors. `noise` is the image's variance in terms of numpy's."""
    variance = variance * (1 + noise)
    errors = np.sqrt(variance.sum((0, 1))) / (WIDTH * HEIGHT)
    whole = np.abs(image.mean((0, 1)) - mean.mean((0, 1))) / errors
    apart = (blocks(image) - blocks(mean)) / np.sqrt(blocks(variance) / BLOCK**2 + 1e-16)
    worst = np.unravel_index(np.abs(apart).argmax(), apart.shape)
    ratios = " ".join(f"{r:.5f} ± {e:.5f}" for r, e in zip(image.mean((0, 1)) / mean.mean((0, 1)), errors / mean.mean((0, 1))))
    print(f"{name}: {ratios}; block {blocks(image)[worst] / blocks(mean)[worst]:.5f}, {apart[worst]:+.1f} standard errors",
          flush=True)
    return max(whole.max(), np.abs(apart).max())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("-o", "--output", type=Path, default=Path("out/radiance-field"))
    parser.add_argument("--samples", type=int, default=300)
    parser.add_argument("--mitsuba", action="store_true")
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    scenes.write_files(arguments.output)
    cloud, worst = cloud_of(arguments.output / "cloud.ply"), 0
    for name, parameter, most in CASES:
        scene = arguments.output / (name.replace(" ", "-") + ".xml")
        scene.write_text(scenes.field(parameter))
        mean, variance = by_numpy(cloud, most, arguments.samples)
        ours = by_photonproof(str(Path(arguments.program).resolve()), scene, arguments.samples)
        worst = max(worst, judge(f"photonproof, {name}", ours, mean, variance, 1 / 16))
        if arguments.mitsuba:
            judge(f"Mitsuba, {name}", by_mitsuba(scene, arguments.samples), mean, variance, 1 / 4)
    return 1 if worst > 4.5 else 0


if __name__ == "__main__":
    sys.exit(main())
