"""What is known of the kernel without volver: python3 test_kernel.py"""

import math
import unittest

import kernel


def task(length, n, extinction, emission):
    """A ray of n segments, as volver asks for it."""

    def samples(places):
        return {
            "lambda": places,
            "extinction": [extinction(x) for x in places],
            "emission": [[emission(x) for x in places]],
        }

    edges = [length * i / n for i in range(n + 1)]
    middles = [length * (2 * i + 1) / (2 * n) for i in range(n)]
    data = {"form": "segments", "edges": samples(edges), "middles": samples(middles)}
    return {"channels": ["radiance"], "length": length, "step": length / n, "segments": n, "seed": 0, "data": data}


class Kernel(unittest.TestCase):
    def test_a_homogeneous_ray_is_exact(self):
        [radiance] = kernel.render(task(2.0, 7, lambda x: 0.75, lambda x: 3.0))
        self.assertAlmostEqual(radiance, 3.0 * (1.0 - math.exp(-1.5)), delta=1e-14)

    def test_the_error_falls_with_the_second_power_of_the_step(self):
        # The depth is x^2, and the emission too: the integral of t e^(-t) up to 1.
        exact = 1.0 - 2.0 / math.e
        ray = lambda n: task(1.0, n, lambda x: 2.0 * x, lambda x: x * x)
        coarse, fine = (abs(kernel.render(ray(n))[0] - exact) for n in (64, 128))
        self.assertAlmostEqual(math.log2(coarse / fine), 2.0, delta=0.05)


if __name__ == "__main__":
    unittest.main()
