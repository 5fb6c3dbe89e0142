// Subdivide on a cell of the image's quadtree: BeamCast on its beam from where the parent's found something; what is
// not empty is handed to its four quarters. BeamCast stops at pieces half as deep at each further level (ε / 2).
// `path` is the way taken from the whole beam, 1: a 0 or a 1 for each half in depth chosen.
void cast_cell(Work work, Cell cell) {
    Beam beam = cell_beam(work, cell);
    Hit hit = no_hit(beam.far);
    int deepest = cell.level + BISECTIONS;
    int depth = cell.path == 1 ? 0 : deepest - 1;
    int path = cell.path;
    real width = (beam.far - beam.near) / real(1 << depth);
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
    if (hit.status == MISS || cell.level == work.last) {
        paint(work, cell, hit);
    } else {
        queue_quarters(work, cell, path, hit);
    }
}
