#!/usr/bin/env python3
"""Measures POV-Ray's pictures of the scene library against our reference integrators.

  reference/povray/measure_library.py build/release/bin/photonproof --keep out/povray [--update] [SCENE ...]

Every scene is rendered by POV-Ray (size and quality as below, one thread) and compared with the library's own reference
where the scene has one, of whose size it then is, or else with an integrator that shares no code with it, for
as long as `--seconds` says; the pictures stay in the folder that `--keep` names, and references that are there are used
again. Printed is a line a scene. With --update the figures go to [povray] of the scenes' expect.toml, whose
`cause` is kept where the figures need one, and all scenes' to the table in reports/published/povray.md.
"""

import argparse
import json
import pathlib
import re
import subprocess
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
LIBRARY = ROOT / "scenes" / "library"
TABLE = ROOT / "reports" / "published" / "povray.md"
REFUSAL = "not representable in POV-Ray: "

# Who finds the light of a scene; path where nothing is said.
INTEGRATORS = {
    "bdpt": ["cornell-spheres", "course-1", "caustic-glass", "mirror-light", "keyhole", "corridor"],
    "ptracer": ["ball-lens"],
    "volpath": ["absorption"],
}


# POV-Ray's fisheye is written for square pictures only.
SQUARE = ["chart-fisheye"]


def integrator_of(scene):
    return next((name for name, scenes in INTEGRATORS.items() if scene in scenes), "path")


def run(words):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False)


def stored_reference(scene):
    """Width, height and file of a reference in the scene's folder, the widest."""
    stored = []
    for image in (LIBRARY / scene).glob("reference-*.exr"):
        width, height = map(int, re.fullmatch(r"reference-(\d+)x(\d+)", image.stem).groups())
        if width == height or scene not in SQUARE:
            stored.append((width, height, image))
    return max(stored, default=None)


def size_of(scene, options):
    stored = stored_reference(scene)
    return stored[:2] if stored else (options.size, options.size)


def reference_of(program, scene, options):
    stored = stored_reference(scene)
    if stored:
        return stored[2]
    image = options.keep / f"{scene}-reference-{options.size}.exr"
    if not image.exists():
        done = run([program, "render", LIBRARY / scene / "scene.xml", "-o", image, "--integrator", integrator_of(scene),
                    "--size", f"{options.size}x{options.size}", "--seconds", options.seconds, "--seed", 7, "--quiet"])
        if done.returncode != 0:
            sys.exit(f"{scene}: {done.stderr.strip()}")
    return image


def measure(program, scene, options):
    """Figures of a scene, or the sentence by which it is refused."""
    image = options.keep / f"{scene}.exr"
    width, height = size_of(scene, options)
    done = run([program, "povray", LIBRARY / scene / "scene.xml", "-o", image, "--quality", options.quality, "--size",
                f"{width}x{height}", "--quiet", "--json"])
    if done.returncode == 3:
        return done.stderr.strip().split("\n")[-1].split(REFUSAL)[1]
    if done.returncode != 0:
        sys.exit(f"{scene}: {done.stderr.strip()}")
    stats = json.loads(done.stdout)
    compared = run([program, "compare", reference_of(program, scene, options), image, "--json", "--metrics",
                    "bias,relmse,ssim"])
    metrics = {row["name"]: row["value"] for row in json.loads(compared.stdout)["metrics"]}
    return {"mean_percent": round(100 * metrics["bias"], 2) + 0.0, "relmse": float(f"{metrics['relmse']:.1e}"),
            "ssim": round(metrics["ssim"], 4), "seconds": round(stats["cpu_seconds"], 1)}


def without_table(text, name):
    return re.sub(rf"(?ms)^\n?\[{name}\]\n.*?(?=^\n?\[|\Z)", "", text)


def update_expect(scene, found, options):
    path = LIBRARY / scene / "expect.toml"
    text = path.read_text()
    cause = re.search(r"(?ms)^\[povray\]\n.*?^(cause = .*?)$", text)
    text = without_table(text, "povray")
    text = re.sub(r"(?m)^povray = .*\n", "", text)
    text = re.sub(r"(?m)\n?^\[unsupported\]\n(?=\n?\[|\Z)", "", text)
    if isinstance(found, str):
        line = f"povray = {json.dumps(found)}\n"
        if "[unsupported]\n" in text:
            text = text.replace("[unsupported]\n", "[unsupported]\n" + line)
        else:
            text = text.rstrip("\n") + "\n\n[unsupported]\n" + line
    else:
        text = text.rstrip("\n") + "\n\n[povray]\n" + f"size = {size_of(scene, options)[0]}\nquality = {options.quality}\n"
        text += "".join(f"{key} = {value}\n" for key, value in found.items())
        if cause and (abs(found["mean_percent"]) > 0.5 or found["ssim"] < 0.98):
            text += cause.group(1) + "\n"
    path.write_text(text)


def table_row(scene, found, cause):
    if isinstance(found, str):
        return f"| `{scene}` | refused: {found} | | | | |"
    why = f" ({cause})" if cause else ""
    return (f"| `{scene}` | {found['mean_percent']:+.2f} %{why} | {found['ssim']:.4f} | {found['relmse']:.1e} | "
            f"{found['seconds']:.1f} | {found['size']} |")


def declared(scene):
    """The row of what a scene's expect.toml says; empty where it says nothing."""
    expect = tomllib.loads((LIBRARY / scene / "expect.toml").read_text())
    refusal = expect.get("unsupported", {}).get("povray")
    if refusal:
        return table_row(scene, refusal, None)
    residual = expect.get("povray")
    return table_row(scene, residual, residual.get("cause")) if residual else ""


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--keep", type=pathlib.Path, required=True)
    parser.add_argument("--size", type=int, default=96)
    parser.add_argument("--quality", type=int, default=2)
    parser.add_argument("--seconds", type=float, default=20)
    parser.add_argument("--update", action="store_true")
    parser.add_argument("scenes", nargs="*")
    options = parser.parse_intermixed_args()
    options.keep.mkdir(parents=True, exist_ok=True)
    scenes = options.scenes or sorted(path.parent.name for path in LIBRARY.glob("*/scene.xml"))
    for scene in scenes:
        found = measure(options.program, scene, options)
        if options.update:
            update_expect(scene, found, options)
        shown = found if isinstance(found, str) else {**found, "size": size_of(scene, options)[0]}
        print(table_row(scene, shown, None), flush=True)
    if options.update:
        rows = [row for row in map(declared, sorted(path.parent.name for path in LIBRARY.glob("*/scene.xml"))) if row]
        TABLE.write_text(
            "# POV-Ray on the scene library\n\n```sh\nreference/povray/measure_library.py build/release/bin/photonproof "
            "--keep out/povray --update --quality 1\n```\n\n"
            "Quality 1, one thread: the mean against the library's own reference, or where it has none (96 pixels across) "
            "against `path` (`bdpt` where mirrors or narrow holes hide the "
            "light, `ptracer` for `ball-lens`, `volpath` where a medium absorbs), ssim, relmse and seconds of processor time. The references have "
            "noise of their own. In brackets the cause, where the mean is off by more than 0.5 % or ssim is below "
            "0.98.\n\n| scene | mean | ssim | relmse | s | pixels across |\n|---|--:|--:|--:|--:|--:|\n" + "\n".join(rows) + "\n")


if __name__ == "__main__":
    main()
