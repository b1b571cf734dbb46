"""Exitant radiance of the isotropic index-matched half-space, averaged over equal bins of the exitant cosine, weighed as flux
is (by mu), per unit irradiance: L / E = alpha H(mu) H(mu0) / (4 pi (mu + mu0)) (Chandrasekhar 1960), H from hfunc.py.
Writes c1b_angular_bins.csv beside this folder; err_bound is 2 x |rule - half as many nodes| + 1e-14. Needs numpy and mpmath.
"""
import os

import numpy as np

from hfunc import H_fast

BINS = 10
CASES = [(0.3, 1.0), (0.5, 0.5), (0.9, 1.0), (0.9, 0.2), (0.99, 0.7)]


def bin_average(alpha, mu0, low, high, nodes):
    """Gauss-Legendre in s with mu = low + (high - low) s^4, which smooths the start at mu = 0."""
    x, w = np.polynomial.legendre.leggauss(nodes)
    s, w = 0.5 * (x + 1), 0.5 * w
    mu = low + (high - low) * s**4
    weight = w * 4 * s**3 * mu
    radiance = alpha * H_fast(mu, alpha) * H_fast([mu0], alpha)[0] / (4 * np.pi * (mu + mu0))
    return np.sum(weight * radiance) / np.sum(weight)


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    with open(os.path.join(here, '..', 'c1b_angular_bins.csv'), 'w') as out:
        out.write('alpha,mu0,bins,bin,mu_low,mu_high,L_over_E,err_bound\n')
        for alpha, mu0 in CASES:
            for k in range(BINS):
                low, high = k / BINS, (k + 1) / BINS
                fine, coarse = (bin_average(alpha, mu0, low, high, n) for n in (40, 20))
                out.write(f'{alpha},{mu0},{BINS},{k},{low},{high},{fine:.15g},{2 * abs(fine - coarse) + 1e-14:.2g}\n')


if __name__ == '__main__':
    main()
