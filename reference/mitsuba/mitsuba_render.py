"""Renders a scene by Mitsuba 3 in batches of their own seeds: SCENE.xml OPTIONS.json FOLDER.

Batch i goes to batch_i.exr in the folder, and versions and times to engine.json. Lines "photonproof: i" on standard error
count the batches. OPTIONS has `variant`, `threads`, `plugins`, and `batches`, a list of (samples a pixel, seed).
"""
import glob
import json
import os
import re
import sys
import time

OLDEST_LLVM = 17  # Dr.Jit's code for older ones ends with "Cannot select: fminimum"


def llvm_version(path):
    """Of the library's real name; None where that does not say."""
    found = re.search(r"LLVM(?:-|\.so\.)(\d+)", os.path.basename(os.path.realpath(path)))
    return int(found.group(1)) if found else None


def find_llvm():
    """The newest libLLVM that Dr.Jit can use, or the one that DRJIT_LIBLLVM_PATH names, or None."""
    given = os.environ.get("DRJIT_LIBLLVM_PATH")
    if given:
        return given if os.path.exists(given) and (llvm_version(given) or OLDEST_LLVM) >= OLDEST_LLVM else None
    places = ("/usr/lib/*/libLLVM*.so*", "/usr/lib/llvm-*/lib/libLLVM*.so*", "/usr/lib64/libLLVM*.so*",
              "/usr/local/lib/libLLVM*.so*")
    found = [(llvm_version(path) or 0, path) for place in places for path in glob.glob(place)]
    version, path = max(found, default=(0, None))
    return path if version >= OLDEST_LLVM else None


def chosen_variant(asked):
    if asked.startswith("llvm") or asked == "auto":
        llvm = find_llvm()
        if llvm:
            os.environ["DRJIT_LIBLLVM_PATH"] = llvm
            return "llvm_ad_rgb" if asked == "auto" else asked
        if asked != "auto":
            sys.exit(f"Error: the variant {asked} needs libLLVM {OLDEST_LLVM} or newer, which DRJIT_LIBLLVM_PATH may name")
    return "scalar_rgb" if asked == "auto" else asked


def main(scene_file, options_file, folder):
    with open(options_file, encoding="utf-8") as file:
        options = json.load(file)
    times, last = {}, time.monotonic()

    def lap(name):
        nonlocal last
        now = time.monotonic()
        times[name] = round(now - last, 4)
        last = now

    variant = chosen_variant(options["variant"])
    import drjit as dr
    import mitsuba as mi
    if variant not in mi.variants():
        sys.exit(f"Error: Mitsuba has no variant {variant}, only {', '.join(mi.variants())}")
    mi.set_variant(variant)
    mi.set_log_level(mi.LogLevel.Error)
    # OpenEXR in Mitsuba waits forever for a second thread.
    threads = options["threads"]
    dr.set_thread_count(max(2, threads))
    is_compiled = not variant.startswith("scalar")
    if is_compiled:
        dr.set_flag(dr.JitFlag.KernelHistory, True)
    register_plugins(mi, dr, options["plugins"])
    lap("import_seconds")
    scene = mi.load_file(scene_file)
    lap("load_seconds")

    compiled = 0.0
    for i, (samples, seed) in enumerate(options["batches"]):
        dr.set_thread_count(threads)
        image = mi.render(scene, spp=samples, seed=seed)
        dr.eval(image)
        dr.sync_thread()
        dr.set_thread_count(max(2, threads))
        bitmap = mi.Bitmap(image).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, srgb_gamma=False)
        bitmap.write(os.path.join(folder, f"batch_{i}.exr"))
        if is_compiled:
            compiled += sum(kernel.get("codegen_time", 0) + kernel.get("backend_time", 0) for kernel in dr.kernel_history())
        print(f"photonproof: {i + 1}", file=sys.stderr, flush=True)
    lap("render_seconds")
    times["compile_seconds"] = round(compiled / 1000, 4)
    times["render_seconds"] = round(max(0.0, times["render_seconds"] - compiled / 1000), 4)
    facts = {"version": f"Mitsuba {mi.__version__}", "variant": variant, **times}
    with open(os.path.join(folder, "engine.json"), "w", encoding="utf-8") as file:
        json.dump(facts, file)


if __name__ == "__main__":
    main(*sys.argv[1:4])
