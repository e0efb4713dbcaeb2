#!/usr/bin/env python3
"""The passes file of a Mitsuba 3 scene: mitsuba_passes.py SCENE.xml PASSES.exr [SAMPLES]

Glossy becomes what is a mirror in the scene (the BSDF `conductor`). Then, as often as you like:
glossfilter PASSES.exr --roughness 0.2 -o picture.png

Needs Mitsuba and NumPy: pip install mitsuba numpy.
"""
import sys

import mitsuba as mi
import numpy as np

mi.set_variant("scalar_rgb")

CHANNELS = ["R", "G", "B", "specular.R", "specular.G", "specular.B", "reflectance.R", "reflectance.G", "reflectance.B",
            "P.X", "P.Y", "P.Z", "endpoint.X", "endpoint.Y", "endpoint.Z", "endpoint.W"]


def look(scene, sampler, place):
    """What the camera sees at `place` (0 to 1): ray, hit and, of a mirror, its reflectance and the mirrored ray."""
    ray, _ = scene.sensors()[0].sample_ray(0, 0.5, place, [0.5, 0.5])
    hit = scene.ray_intersect(ray)
    if not hit.is_valid() or not mi.has_flag(hit.bsdf().flags(), mi.BSDFFlags.DeltaReflection):
        return ray, hit, None, None
    sample, weight = hit.bsdf().sample(mi.BSDFContext(), hit, sampler.next_1d(), sampler.next_2d())
    return ray, hit, np.array(weight), hit.spawn_ray(hit.to_world(sample.wo))


def pixel_passes(scene, sampler, x, y, size, samples):
    def radiance(ray):
        return np.array(scene.integrator().sample(scene, sampler, ray)[0])

    # Positions belong to the pixel's centre: an average of them lies on no surface.
    _, hit, glossy, mirrored = look(scene, sampler, [(x + 0.5) / size[0], (y + 0.5) / size[1]])
    endpoint, specular = [0, 0, 0, 0], np.zeros(3)
    if glossy is not None:
        end = scene.ray_intersect(mirrored)
        endpoint = [*end.p, 1] if end.is_valid() else [*mirrored.d, 0]
        specular = sum(radiance(mirrored) for _ in range(samples)) / samples

    # Radiance and coverage may be averaged.
    base, reflectance = np.zeros(3), np.zeros(3)
    for _ in range(samples):
        dx, dy = sampler.next_2d()
        ray, _, weight, _ = look(scene, sampler, [(x + dx) / size[0], (y + dy) / size[1]])
        if weight is None:
            base += radiance(ray) / samples
        else:
            reflectance += weight / samples
    position = hit.p if hit.is_valid() else [0, 0, 0]
    return [*base, *specular, *reflectance, *position, *endpoint]


def main(scene_file, output, samples="16"):
    scene = mi.load_file(scene_file)
    sensor, sampler = scene.sensors()[0], scene.sensors()[0].sampler().clone()
    size = sensor.film().crop_size()
    sampler.seed(0)
    image = [[pixel_passes(scene, sampler, x, y, size, int(samples)) for x in range(size[0])] for y in range(size[1])]

    bitmap = mi.Bitmap(np.array(image, np.float32), mi.Bitmap.PixelFormat.MultiChannel, CHANNELS)
    camera = mi.traverse(sensor)
    bitmap.metadata()["povgloss:eye"] = camera["to_world"].translation()
    bitmap.metadata()["povgloss:viewAngle"] = float(np.radians(camera["x_fov"]))
    bitmap.write(output)


if __name__ == "__main__":
    main(*sys.argv[1:])
