// The floor: no work at all.
Hit first_hit(Ray ray, real t0, real t1) {
    return no_hit(t0);
}
