// A polynomial's coefficients from its values s at NODES by the whole inverse matrix, row by row, as szente, section 2.1,
// prints it: one product for each entry. Reads tables of harness.kernels.fitting, so it stands after them.
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
