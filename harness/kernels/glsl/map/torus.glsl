// A torus with R = 3/4 and r = 1/4, and Newton's method along a ray: what methods do, for programs of fingerprints.
#define LONGEST 0.125
#define NEAREST 0.00006103515625

real torus_value(vec3 p) {
    real flat_square = p.x * p.x + p.y * p.y;
    real square = flat_square + p.z * p.z + 0.5;
    return square * square - 2.25 * flat_square;
}

vec3 torus_gradient(vec3 p) {
    real square = p.x * p.x + p.y * p.y + p.z * p.z + 0.5;
    real across = 4.0 * square - 4.5;
    return vec3(p.x * across, p.y * across, 4.0 * (p.z * square));
}

void torus_along(Ray ray, OUT real c[5]) {
    real p0 = inner_product(ray.origin, ray.origin) + 0.5;
    real p1 = 2.0 * inner_product(ray.origin, ray.direction);
    real p2 = inner_product(ray.direction, ray.direction);
    real f0 = ray.origin.x * ray.origin.x + ray.origin.y * ray.origin.y;
    real f1 = 2.0 * (ray.origin.x * ray.direction.x + ray.origin.y * ray.direction.y);
    real f2 = ray.direction.x * ray.direction.x + ray.direction.y * ray.direction.y;
    c[0] = p0 * p0 - 2.25 * f0;
    c[1] = 2.0 * p0 * p1 - 2.25 * f1;
    c[2] = 2.0 * p0 * p2 + p1 * p1 - 2.25 * f2;
    c[3] = 2.0 * p1 * p2;
    c[4] = p2 * p2;
}

// Takes Newton steps of bounded length, and leaves at once where it has converged or left the ray.
Hit newton_hit(IN real c[5], real t0, real t1) {
    Hit hit = no_hit(t1);
    real longest = LONGEST;
    real t = t0;
    while (hit.evaluations < 200) {
        real value = c[4];
        real slope = value;
        for (int j = 3; j > 0; j--) {
            value = value * t + c[j];
            slope = slope * t + value;
        }
        value = value * t + c[0];
        hit.evaluations += 1;
        real way = slope == 0.0 ? longest : clamp(-value / slope, -longest, longest);
        t += fabs(way);
        if (t > t1) return missed(hit);
        if (fabs(way) < NEAREST) return hit_at(hit, t);
    }
    return exhausted(hit, t);
}
