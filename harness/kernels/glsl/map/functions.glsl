// Shows the library's functions that formulas and methods call, and a search over a formula of them.
// harness/devices/fingerprint.py hashes what it answers, part by part. x[0] is an angle, small or large, x[1] an
// exponent, x[2] is positive, x[3] from -1 to 1, and x[4] any number.
#define INPUTS 5
#define OUTPUTS 24

real wave(vec3 p) {
    return sin(p.x) * cos(p.y) + sin(p.y) * cos(p.z) + sin(p.z) * cos(p.x);
}

Dual wave_along(Ray ray, real t) {
    vec3 p = ray_point(ray, t);
    real sx = sin(p.x);
    real cx = cos(p.x);
    real sy = sin(p.y);
    real cy = cos(p.y);
    real sz = sin(p.z);
    real cz = cos(p.z);
    vec3 slope = vec3(cx * cy - sz * sx, cy * cz - sx * sy, cz * cx - sy * sz);
    return make_dual(sx * cy + sy * cz + sz * cx, inner_product(slope, ray.direction));
}

void map_item(IN real x[INPUTS], OUT real y[OUTPUTS]) {
    // exp: 3
    y[0] = exp(x[1]);
    y[1] = exp(x[4]);
    y[2] = exp(-x[0] * x[0]);
    // log: 3
    y[3] = log(x[2]);
    y[4] = log(x[4]);
    y[5] = log(1.0 + x[3] * x[3]);
    // sin: 2
    y[6] = sin(x[0]);
    y[7] = sin(x[4]);
    // cos: 2
    y[8] = cos(x[0]);
    y[9] = cos(x[4]);
    // tan: 2
    y[10] = tan(x[0]);
    y[11] = tan(x[4]);
    // angles: 3
    y[12] = asin(x[3]);
    y[13] = acos(x[3]);
    y[14] = atan(x[0]);
    // powers: 3
    y[15] = exp2(x[3] * 64.0);
    y[16] = log2(x[2]);
    y[17] = pow(x[2], x[3]);
    // waves: 6
    Ray ray = make_ray(vec3(x[3], 2.0 * x[3], -x[3]), unit_vector(vec3(1.0, x[3], 0.5 - x[3])));
    Hit hit = no_hit(0.0);
    real t = 0.0;
    while (hit.evaluations < 60 && hit.status == MISS) {
        Dual f = wave_along(ray, t);
        hit.evaluations += 1;
        real way = f.derivative == 0.0 ? real(0.25) : clamp(-f.value / f.derivative, real(-0.25), real(0.25));
        t += fabs(way);
        if (fabs(way) < 0.00006103515625) hit = hit_at(hit, t);
    }
    Interval grown = interval_log(interval_exp(make_interval(x[3], x[3] + 0.125)));
    y[18] = hit.t;
    y[19] = real(hit.evaluations * 4 + hit.status);
    y[20] = wave(ray_point(ray, hit.t));
    y[21] = exp(-hit.t) * sin(3.0 * hit.t);
    y[22] = grown.lo;
    y[23] = grown.hi;
}
