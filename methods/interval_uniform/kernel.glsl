// BeamCast on a pixel's beam (beamcasting, section III.B): finds the first piece in depth over whose box f's range
// contains 0, by bisection, nearest half first. `path` is the way from the whole beam, which is 1, to a piece: a
// further binary digit for each halving, 0 for the near half and 1 for the far half.
void cast_cell(Work work, Cell cell) {
    Beam beam = cell_beam(work, cell);
    Hit hit = no_hit(beam.far);
    int deepest = work.last + BISECTIONS;
    int depth = 0;
    int path = 1;
    real width = beam.far - beam.near;
    bool searching = true;
    while (searching) {
        real s0 = path_depth(beam, path, width);
        real s1 = path_depth(beam, path + 1, width);
        Box box = beam_box(beam, s0, s1);
        bool empty = outside_domain(box);
        if (!empty) {
            Interval range = box_range(box);
            hit.evaluations += 1;
            empty = range.lo > 0.0 || range.hi < 0.0;
        }
        if (empty) {
            int up = trailing_zeros(path + 1);
            path = (path + 1) >> up;
            depth -= up;
            width *= real(1 << up);
            searching = path != 1;
        } else if (depth < deepest) {
            path *= 2;
            depth += 1;
            width *= 0.5;
        } else {
            hit = hit_at(hit, 0.5 * (s0 + s1));
            searching = false;
        }
    }
    paint(work, cell, hit);
}
