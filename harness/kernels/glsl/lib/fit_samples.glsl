// Computes a polynomial's coefficients from its values at Chebyshev's nodes (szente, section 2.1). Rows of the inverse
// matrix are multiplied with the sums and the differences of opposite samples. Reads the tables that
// harness.kernels.fitting makes, and so comes after them in a program.
#define FIT_EVENS (SURFACE_DEGREE / 2 + 1)
#define FIT_ODDS ((SURFACE_DEGREE + 1) / 2)

Factor sum_factor(real a, real b, bool compensated) {
    return make_factor(compensated ? two_sum(a, b) : make_pair(a + b, 0.0));
}

Pair next_sum(Pair sum, real hi, real lo, Factor b, bool compensated) {
    return compensated ? plus_product(sum, hi, lo, b) : make_pair(sum.hi + hi * b.hi, 0.0);
}

Pair even_row(IN Factor sums[FIT_EVENS], int row, bool compensated) {
    Pair sum = make_pair(0.0, 0.0);
    for (int i = 0; i < FIT_EVENS; i++) {
        sum = next_sum(sum, EVEN_HI[row * FIT_EVENS + i], EVEN_LO[row * FIT_EVENS + i], sums[i], compensated);
    }
    return sum;
}

Pair odd_row(IN Factor differences[FIT_ODDS], int row, bool compensated) {
    Pair sum = make_pair(0.0, 0.0);
    for (int i = 0; i < FIT_ODDS; i++) {
        sum = next_sum(sum, ODD_HI[row * FIT_ODDS + i], ODD_LO[row * FIT_ODDS + i], differences[i], compensated);
    }
    return sum;
}

// Turns the values s at NODES into coefficients c, in the basis that the tables are for: monomials in x, or the
// Bernstein basis if `bernstein`. Unless `compensated`, sums and products are rounded as usual.
void fit(IN real s[COEFFICIENTS], bool bernstein, bool compensated, OUT real c[COEFFICIENTS]) {
    Factor sums[FIT_EVENS];
    Factor differences[FIT_ODDS];
    for (int i = 0; i < FIT_ODDS; i++) {
        sums[i] = sum_factor(s[SURFACE_DEGREE - i], s[i], compensated);
        differences[i] = sum_factor(s[SURFACE_DEGREE - i], -s[i], compensated);
    }
    if (FIT_EVENS > FIT_ODDS) sums[FIT_EVENS - 1] = sum_factor(s[SURFACE_DEGREE / 2], 0.0, compensated);
    for (int r = 0; r < FIT_ODDS; r++) {
        Pair even = even_row(sums, r, compensated);
        Pair odd = odd_row(differences, r, compensated);
        if (bernstein) {
            c[r] = (even.hi - odd.hi) + (even.lo - odd.lo);
            c[SURFACE_DEGREE - r] = (even.hi + odd.hi) + (even.lo + odd.lo);
        } else {
            c[2 * r] = even.hi + even.lo;
            c[2 * r + 1] = odd.hi + odd.lo;
        }
    }
    if (FIT_EVENS > FIT_ODDS) {
        Pair even = even_row(sums, FIT_EVENS - 1, compensated);
        c[bernstein ? SURFACE_DEGREE / 2 : SURFACE_DEGREE] = even.hi + even.lo;
    }
}
