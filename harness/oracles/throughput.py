"""Times `compare` beside idiff and scikit-image; throughput.sh says how and is what one runs."""
import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

import exr_file
import image_pairs

WIDTH, HEIGHT = 3840, 2160


def pair():
    """Smooth colours, an edge and two amounts of noise, exact in half floats."""
    random = np.random.Generator(np.random.PCG64(1))
    y, x = np.mgrid[0:HEIGHT, 0:WIDTH]
    image = np.stack((0.2 + x / WIDTH, 0.05 + 0.8 * y / HEIGHT, 0.3 + 0.2 * np.sin(x * 0.01) * np.cos(y * 0.013)), axis=-1)
    image[HEIGHT // 3:HEIGHT // 2, WIDTH // 4:WIDTH // 3] = (0.02, 0.25, 3.5)
    noisy = [image * (1 + sigma * random.standard_normal(image.shape)) for sigma in (0.05, 0.1)]
    return [np.asarray(one, dtype=np.float16).astype(np.float64) for one in noisy]


def process(*command):
    def run():
        begin = time.perf_counter()
        code = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False).returncode
        if code not in (0, 2):  # idiff fails by default when pixels differ
            sys.exit(f"throughput: {command[0]} exited with {code}")
        return time.perf_counter() - begin
    return run


def ssim_in_memory(bench):
    if not os.access(bench, os.X_OK):
        return None

    def run():
        out = subprocess.run((bench, "--benchmark_filter=^ssim_4k", "--benchmark_format=json"), capture_output=True,
                             check=True).stdout
        return json.loads(out)["benchmarks"][0]["real_time"]  # seconds
    return run


def scikit_image(images):
    try:
        from skimage.metrics import structural_similarity
    except ImportError:
        return None
    shown = [image_pairs.display(image, 0) for image in images]

    def run():
        begin = time.perf_counter()
        structural_similarity(*shown, gaussian_weights=True, sigma=1.5, use_sample_covariance=False, data_range=1,
                              channel_axis=2)
        return time.perf_counter() - begin
    return run


def main():
    program, repetitions = sys.argv[1], int(sys.argv[2])
    images = pair()
    with tempfile.TemporaryDirectory() as folder:
        files = [os.path.join(folder, name) for name in ("reference.exr", "test.exr")]
        for file, image in zip(files, images):
            exr_file.write(file, image)
        ours = lambda *options: process(program, "compare", *files, *options)
        timed = {"all metrics": ours(), "mse": ours("--metrics", "mse")}
        timed["ssim"] = ssim_in_memory(os.path.join(os.path.dirname(program), "bench", "metrics_bench"))
        timed["idiff"] = process("idiff", *files) if shutil.which("idiff") else None
        timed["scikit-image ssim"] = scikit_image(images)
        for name in [name for name, run in timed.items() if run is None]:
            print(f"{name}: not installed, left out")
            del timed[name]
        seconds = {name: [] for name in timed}
        for _ in range(repetitions):
            for name, run in timed.items():
                seconds[name].append(run())
    for name, values in seconds.items():
        print(f"{name}: {statistics.median(values):.3f} s, median of {repetitions}")
    for name, peer in (("mse", "idiff"), ("ssim", "scikit-image ssim")):
        if peer in seconds and name in seconds:
            ratio = statistics.median(theirs / mine for theirs, mine in zip(seconds[peer], seconds[name]))
            print(f"{name}: {ratio:.1f} times as fast as {peer}")


if __name__ == "__main__":
    main()
