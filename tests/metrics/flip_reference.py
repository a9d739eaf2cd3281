#!/usr/bin/env python3
"""Prints the known answers of flip_test.cpp. They were made with flip-evaluator 1.7 from PyPI, the implementation of
FLIP's authors:  pip install flip-evaluator==1.7 numpy && python3 flip_reference.py
The pictures are those of picture(), noisy(), blurred() and tinted() in flip_test.cpp."""

import flip_evaluator
import numpy

WIDTH, HEIGHT = 96, 64
MASK = (1 << 64) - 1


def hash64(x):
    """The function of that name in src/base/random.h."""
    x = (x + 0x9E3779B97F4A7C15) & MASK
    x = ((x ^ (x >> 30)) * 0xBF58476D1CE4E5B9) & MASK
    x = ((x ^ (x >> 27)) * 0x94D049BB133111EB) & MASK
    return x ^ (x >> 31)


def picture():
    """Waves of colour, with hard-edged squares in the lower half."""
    y, x = numpy.mgrid[0:HEIGHT, 0:WIDTH]
    waves = [0.5 + 0.4 * numpy.sin(0.31 * x + 0.05 * y),
             0.5 + 0.35 * numpy.sin(0.11 * x - 0.23 * y),
             0.5 + 0.3 * numpy.cos(0.17 * x + 0.07 * y)]
    dark = (y >= HEIGHT // 2) & ((x // 6 + y // 6) % 2 == 0)
    return numpy.stack([numpy.where(dark, 0.1 * wave, wave) for wave in waves], axis=-1)


def noisy(image):
    noise = [(hash64(i) >> 40) / 2**24 for i in range(image.size)]
    return numpy.clip(image + 0.2 * (numpy.array(noise).reshape(image.shape) - 0.5), 0, 1)


def blurred(image):
    """Mean of 3 x 3 pixels; outside, the border goes on."""
    wide = numpy.pad(image, ((1, 1), (1, 1), (0, 0)), mode="edge")
    return sum(wide[j:j + HEIGHT, i:i + WIDTH] for j in range(3) for i in range(3)) / 9


def tinted(image):
    return (image * [0.8, 1.0, 1.1]).clip(0, 1)


for make in (noisy, blurred, tinted):
    reference = picture().astype(numpy.float32)
    test = make(picture()).astype(numpy.float32)
    error_map, mean, _ = flip_evaluator.evaluate(reference, test, "LDR", inputsRGB=False, applyMagma=False)
    error_map = error_map.reshape(HEIGHT, WIDTH, -1)
    print(f"{make.__name__:8} mean {mean:.6f} at (10, 20) {error_map[20, 10, 0]:.6f} at (95, 63) {error_map[63, 95, 0]:.6f}")
