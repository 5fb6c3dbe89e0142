// Beams as a prepass. This is the quadtree search of the method interval_adaptive, stopped at tiles of 2^TILE_BITS
// pixels a side. For each tile it writes two depths s0 and s1 to `t`, between which the rays of the tile meet the
// surface if they meet it at all; both are moved outwards by the width of the last piece searched. If the tile's beam
// misses the surface, s0 > s1. `answer` holds the evaluations spent on the tile.
STRUCT(Search) struct Search { int path; int evaluations; real s0; real s1; };

// Searches the beam for the first piece of depth in which the surface may lie: BeamCast of the beamcasting paper,
// from piece `path`, which is `depth` halvings deep, down to `deepest` halvings. If `mirrored`, searches from the far
// end towards the near end. The result's path is 0 if every piece is empty; else [s0, s1] is the piece found.
Search search_beam(Beam beam, int path, int depth, int deepest, bool mirrored) {
    Search search;
    search.path = path;
    search.evaluations = 0;
    real width = (beam.far - beam.near) / real(1 << depth);
    bool searching = true;
    while (searching) {
        real a = path_depth(beam, search.path, width);
        real b = path_depth(beam, search.path + 1, width);
        search.s0 = mirrored ? max(beam.near + beam.far - b, real(0)) : a;
        search.s1 = mirrored ? beam.near + beam.far - a : b;
        Box box = beam_box(beam, search.s0, search.s1);
        bool empty = outside_domain(box);
        if (!empty) {
            Interval range = box_range(box);
            search.evaluations += 1;
            empty = range.lo > 0.0 || range.hi < 0.0;
        }
        if (empty) {
            int up = trailing_zeros(search.path + 1);
            search.path = (search.path + 1) >> up;
            depth -= up;
            width *= real(1 << up);
            searching = search.path != 1;
            if (!searching) search.path = 0;
        } else if (depth < deepest) {
            search.path *= 2;
            depth += 1;
            width *= 0.5;
        } else {
            searching = false;
        }
    }
    return search;
}

// Writes the depths s0 and s1 to all tiles of a cell, and to each tile its share of the evaluations.
void hand_to_tiles(Work work, Cell cell, real s0, real s1, int evaluations) {
    int side = 1 << max(work.last - TILE_BITS - work.level, 0);
    int tiles = (work.size + (1 << TILE_BITS) - 1) >> TILE_BITS;
    int i1 = min((cell.x + 1) * side, tiles);
    int j1 = min((cell.y + 1) * side, tiles);
    int count = (i1 - cell.x * side) * (j1 - cell.y * side);
    int share = evaluations / count;
    int extra = evaluations - share * count;
    for (int j = cell.y * side; j < j1; j++) {
        for (int i = cell.x * side; i < i1; i++) {
            int tile = j * tiles + i;
            answer_pixel(work, 2 * tile, s0, 0);
            answer_pixel(work, 2 * tile + 1, s1, share + (extra > 0 ? 1 : 0));
            extra -= 1;
        }
    }
}

void cast_cell(Work work, Cell cell) {
    Beam beam = cell_beam(work, cell);
    int deepest = cell.level + PREPASS_BISECTIONS;
    Search nearest = search_beam(beam, cell.path, cell.path == 1 ? 0 : deepest - 1, deepest, false);
    int evaluations = cell.evaluations + nearest.evaluations;
    if (nearest.path == 0) {
        hand_to_tiles(work, cell, 1.0, 0.0, evaluations);
    } else if (cell.level >= work.last - TILE_BITS) {
        Search farthest = search_beam(beam, 1, 0, deepest, true);
        real spare = nearest.s1 - nearest.s0;
        real s1 = farthest.path == 0 ? beam.far : max(nearest.s1, farthest.s1);
        hand_to_tiles(work, cell, nearest.s0 - spare, s1 + spare, evaluations + farthest.evaluations);
    } else {
        Hit hit = no_hit(beam.far);
        hit.evaluations = nearest.evaluations;
        queue_quarters(work, cell, nearest.path, hit);
    }
}
