"""compare_mitsuba.py SCENE.xml PASSES.exr GLOSSFILTER ALPHA SAMPLES: the floor of tests/scenes/mitsuba.xml filtered,
against Mitsuba's own, over the pixels that are glossy: RMSE in linear light.

Prints the exponent, its misfit, and the RMSE of the mirror against Mitsuba's mirror, of the mirror against Mitsuba's
rough floor (Beckmann, slope parameter ALPHA), and of the filtered one against that.
"""
import subprocess
import sys

import mitsuba as mi
import numpy as np

mi.set_variant("scalar_rgb")


def fit(alpha):
    """The exponent p for which cos^p of the angle from the mirror direction is nearest to Beckmann's lobe, seen at
    right angles, by least squares over the hemisphere's solid angle, and the misfit relative to the lobe's norm."""
    angle = np.linspace(0, np.pi / 2, 20001)[:-1]
    half = angle / 2
    lobe = np.exp(-(np.tan(half) / alpha) ** 2) / np.cos(half) ** 4
    exponents = np.geomspace(0.1, 4, 400) / (2 * alpha**2)
    misfits = []
    for p in exponents:
        ours = np.cos(angle) ** p
        area = np.sin(angle)
        scale = np.sum(lobe * ours * area) / np.sum(ours * ours * area)
        misfits.append(np.sqrt(np.sum((lobe - scale * ours) ** 2 * area) / np.sum(lobe**2 * area)))
    best = int(np.argmin(misfits))
    return exponents[best], misfits[best]


def read(path):
    return np.array(mi.Bitmap(path).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False))


def main(scene, passes, glossfilter, alpha, samples):
    exponent, misfit = fit(float(alpha))
    bitmap = mi.Bitmap(passes)
    names = [field.name for field in bitmap.struct_()]
    endpoint = np.array(bitmap)[..., [names.index("endpoint." + component) for component in "XYZ"]]
    glossy = np.abs(endpoint).sum(-1) > 0

    def filtered(p):
        subprocess.run([glossfilter, passes, "--phong", str(p), "-o", "filtered.exr"], check=True)
        return read("filtered.exr")[glossy]

    def rendered(bsdf):
        with open(scene) as file:
            text = file.read().replace('type="conductor">', bsdf)
        return np.array(mi.render(mi.load_string(text), spp=int(samples)))[..., :3][glossy]

    def rmse(a, b):
        return np.sqrt(np.mean((a - b) ** 2))

    mirror, own = filtered("inf"), rendered('type="conductor">')
    rough = rendered(f'type="roughconductor"><float name="alpha" value="{alpha}"/>')
    print(f"exponent {exponent:.1f} misfit {misfit:.4f} mirror {rmse(mirror, own):.4f}"
          f" unfiltered {rmse(mirror, rough):.4f} filtered {rmse(filtered(exponent), rough):.4f}")


main(*sys.argv[1:])
