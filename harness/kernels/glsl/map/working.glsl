// Works as methods do, in a program as long as theirs, since compilers treat short programs and long ones differently.
// harness/devices/fingerprint.py hashes the answers, part by part. x[0] to x[5], from -1 to 1, choose a ray towards the
// torus of torus.glsl, which stands before this file. Its direction has no length in particular, so that it is the same
// on all devices.
#define INPUTS 6
#define OUTPUTS 25
#define LEVEL 8  // degree of the polynomial whose roots are searched

Interval torus_range(Ray ray, real t0, real t1) {
    Interval x = bounded_sqr(bounded_affine(ray.origin.x, ray.direction.x, t0, t1));
    Interval y = bounded_sqr(bounded_affine(ray.origin.y, ray.direction.y, t0, t1));
    Interval z = interval_powi(bounded_affine(ray.origin.z, ray.direction.z, t0, t1), 2);
    Interval flat_square = bounded_add(x, y);
    Interval square = interval_add(bounded_add(flat_square, z), make_interval(0.5, 0.5));
    return interval_sub(bounded_sqr(square), bounded_scale(2.25, flat_square, 2.0));
}

// Halves pieces of the ray until the range of f over one of them holds 0 and it is short enough.
Hit march_hit(Ray ray, real t0, real t1) {
    Hit hit = no_hit(t1);
    real t = t0;
    real width = t1 - t0;
    while (t < t1) {
        if (hit.evaluations == 400) return exhausted(hit, t);
        real end = min(t + width, t1);
        Interval range = torus_range(ray, t, end);
        hit.evaluations += 1;
        if (range.lo > 0.0 || range.hi < 0.0) {
            t = end;
            width = 2.0 * width;
        } else if (width > 0.001953125) {
            width = 0.5 * width;
        } else {
            return hit_at(hit, t + 0.5 * (end - t));
        }
    }
    return hit;
}

// Sets x to the ends of the pieces of [0, 1] on which q is monotone, by the roots of its derivatives, and to q's roots.
void all_roots(IN real q[COEFFICIENTS], INOUT real x[COEFFICIENTS]) {
    real r[COEFFICIENTS];
    x[0] = 0.0;
    for (int d = 2; d <= LEVEL; d++) {
        for (int j = 0; j <= d; j++) {
            real factor = 1.0;
            for (int k = 1; k <= LEVEL - d; k++) factor = factor * real(j + k) / real(k);
            r[j] = factor * q[LEVEL - d + j];
        }
        if (d == 2) {
            x[3] = 1.0;
            quadratic_roots(x, r, false);
        } else {
            split_at_roots(x, r, d, false, 0.0000152587890625, false);
        }
    }
}

// Returns the value at t of the polynomial with coefficients q, in Bernstein's basis, by de Casteljau's scheme.
real casteljau(IN real q[COEFFICIENTS], real t) {
    real b[COEFFICIENTS];
    for (int j = 0; j <= LEVEL; j++) b[j] = q[j];
    for (int m = LEVEL; m > 0; m--) {
        for (int j = 0; j < m; j++) b[j] = (1.0 - t) * b[j] + t * b[j + 1];
    }
    return b[0];
}

void map_item(IN real x[INPUTS], OUT real y[OUTPUTS]) {
    vec3 eye = vec3(4.0 * x[0], 4.0 * x[1], 4.0 * x[2]);
    vec3 aim = vec3(0.75 * x[3], 0.75 * x[4], 0.25 * x[5]);
    vec3 way = difference(aim, eye);
    Ray ray = make_ray(eye, vec3(0.25 * way.x, 0.25 * way.y, 0.25 * way.z));
    real shift = -inner_product(ray.origin, ray.direction) / inner_product(ray.direction, ray.direction);
    Ray own = advanced_ray(ray, shift);
    // newton: 5
    real c[5];
    torus_along(own, c);
    Hit hit = newton_hit(c, -1.25, 1.25);
    y[0] = hit.t;
    y[1] = real(hit.evaluations * 4 + hit.status);
    y[2] = torus_value(ray_point(own, hit.t));
    y[3] = shift;
    y[4] = own.origin.x + own.origin.y * own.origin.z;
    // march: 4
    Hit marched = march_hit(own, -1.25, 1.25);
    Interval range = torus_range(own, marched.t, hit.t);
    y[5] = marched.t;
    y[6] = real(marched.evaluations * 4 + marched.status);
    y[7] = range.lo;
    y[8] = range.hi;
    // normals: 3
    vec3 n = unit_vector(torus_gradient(ray_point(own, marched.t)));
    y[9] = n.x;
    y[10] = n.y * n.z;
    y[11] = max(inner_product(n, own.direction), real(0));
    // roots of polynomials: 5
    real q[COEFFICIENTS];
    real ends[COEFFICIENTS];
    for (int j = 0; j <= LEVEL; j++) {
        real size = real(1 + j * (LEVEL - j));
        q[j] = (is_odd(j) ? -size : size) * (1.0 + 0.5 * x[j - 6 * (j / 6)]);
    }
    all_roots(q, ends);
    y[12] = ends[1];
    y[13] = ends[2] - ends[3];
    y[14] = ends[LEVEL];
    y[15] = casteljau(q, ends[2]);
    y[16] = make_end_bracket(ends[1], ends[LEVEL], -1.0 - x[0], 2.0 + x[1], 1, 4).x;
    // compensated: 5
    Pair horner = make_pair(0.0, 0.0);
    Pair products = make_pair(0.0, 0.0);
    for (int j = LEVEL; j >= 0; j--) {
        horner = pair_sum(pair_scaled(horner, ends[1]), make_pair(q[j], 0.0));
        products = plus_product(products, q[j], 0.0, make_factor(make_pair(ends[2], 0.0)));
    }
    Pair ratio = pair_quotient(pair_product(horner, products), two_sum(q[1], ends[LEVEL]));
    y[17] = horner.hi;
    y[18] = horner.lo;
    y[19] = products.hi + products.lo;
    y[20] = ratio.hi;
    y[21] = ratio.lo;
    // intervals: 3
    Interval angle = interval_sub(make_interval(x[0], x[0] + 0.25), interval_scale(40.0, make_interval(x[1], x[1]), 1.0));
    Interval wave = interval_add(interval_sin(angle), interval_sqrt(interval_abs(interval_cos(angle))));
    Interval share = interval_div(wave, make_interval(1.0 + x[2] * x[2], 3.0));
    y[22] = share.lo;
    y[23] = share.hi;
    y[24] = interval_max(interval_mul(share, angle), wave).hi;
}
