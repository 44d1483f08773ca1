"""The share of all mutants that survives, from samples of parts of different sizes."""

from bench.mutation.all_parts import Sample, share


def test_a_part_counts_by_its_mutants_not_by_those_drawn() -> None:
    rate, low, high = share([Sample(900, 10, 1), Sample(100, 1000, 500)])
    assert rate == 0.9 * 0.1 + 0.1 * 0.5
    assert low < rate < high


def test_a_sample_without_survivors_is_not_certain() -> None:
    rate, low, high = share([Sample(500, 40, 0)])
    assert (rate, low) == (0.0, 0.0)
    assert 0.08 < high < 0.11  # Wilson's interval ends at 0.088


def test_intervals_of_two_halves_are_those_of_the_whole() -> None:
    whole, halves = share([Sample(800, 400, 40)]), share([Sample(400, 200, 20)] * 2)
    assert halves[0] == whole[0]
    assert abs((halves[2] - halves[1]) / (whole[2] - whole[1]) - 1) < 0.02
