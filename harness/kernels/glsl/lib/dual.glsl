// A value with its derivative. Generated code differentiates operation by operation, and fills in both.
STRUCT(Dual) struct Dual { real value; real derivative; };

Dual make_dual(real value, real derivative) {
    Dual dual;
    dual.value = value;
    dual.derivative = derivative;
    return dual;
}
