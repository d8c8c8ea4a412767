#!/usr/bin/env python3
"""rule_s2.py: quantiles of chi^2, and verdicts on pictures of known means. Seed 1; noise of 2 % of the mean in a batch of 64."""
import random
import unittest

import rule_s2


def batches(seed, mean, tile_factors=(1,) * 12, noise=0.02, count=64):
    generator = random.Random(seed)
    result = []
    for _ in range(count):
        tiles = [mean * factor * (1 + noise * generator.gauss(0, 1)) for factor in tile_factors]
        result.append([sum(tiles) / len(tiles)] + tiles)
    return result


class RuleS2(unittest.TestCase):
    def test_tail_of_chi_squared(self):
        for x, freedom, tail in ((3.841459, 1, 0.05), (21.02607, 12, 0.05), (2.705543, 1, 0.1), (51.1790, 12, 9.0e-7)):
            self.assertAlmostEqual(rule_s2.chi_squared_tail(x, freedom) / tail, 1, delta=0.2 if tail < 1e-5 else 1e-4)

    def test_equal_means_pass(self):
        self.assertEqual(rule_s2.Comparison(batches(1, 5), batches(2, 5)).verdict(0.01), "pass")

    def test_a_difference_of_delta_fails(self):
        self.assertEqual(rule_s2.Comparison(batches(1, 5.05), batches(2, 5)).verdict(0.01), "fail")

    def test_light_that_moves_between_tiles_fails(self):
        moved = (1.03, 0.97) * 6
        self.assertEqual(rule_s2.Comparison(batches(1, 5, moved), batches(2, 5)).verdict(0.01), "fail")

    def test_noise_is_inconclusive(self):
        self.assertEqual(rule_s2.Comparison(batches(1, 5, noise=1), batches(2, 5, noise=1)).verdict(0.01), "inconclusive")
        few = rule_s2.Comparison(batches(1, 5, count=32), batches(2, 5, count=32))
        self.assertEqual(few.verdict(0.02), "inconclusive")

    def test_a_stated_difference_has_two_sides(self):
        comparison = rule_s2.Comparison(batches(1, 5.1), batches(2, 5))
        self.assertEqual(comparison.verdict_within(0.015, 0.025, 0.01), "pass")
        self.assertEqual(comparison.verdict_within(-0.005, 0.005, 0.01), "fail")
        self.assertEqual(comparison.verdict_within(0.035, 0.05, 0.01), "fail")

    def test_tiles_of_a_picture(self):
        picture = [1.0 if x < 16 else 3.0 for y in range(16) for x in range(32)]
        self.assertEqual(rule_s2.tile_means(32, 16, picture), [2.0, 1.0, 3.0])


if __name__ == "__main__":
    unittest.main()
