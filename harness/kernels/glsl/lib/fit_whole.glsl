// Computes a polynomial's coefficients from its values s at NODES by the whole inverse matrix, with one product for
// each entry, as szente prints it in section 2.1. Reads the tables that harness.kernels.fitting makes, and so comes
// after them in a program.
void fit_whole(IN real s[COEFFICIENTS], bool compensated, OUT real c[COEFFICIENTS]) {
    Factor samples[SURFACE_DEGREE + 1];
    for (int i = 0; i <= SURFACE_DEGREE; i++) samples[i] = make_factor(make_pair(s[i], 0.0));
    for (int r = 0; r <= SURFACE_DEGREE; r++) {
        Pair sum = make_pair(0.0, 0.0);
        for (int i = 0; i <= SURFACE_DEGREE; i++) {
            int at = r * (SURFACE_DEGREE + 1) + i;
            sum = next_sum(sum, INVERSE_HI[at], INVERSE_LO[at], samples[i], compensated);
        }
        c[r] = sum.hi + sum.lo;
    }
}
