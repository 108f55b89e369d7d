// The kernel of discs, over kernel_scale times the inverse of the squared radius.
FN real disc_weight(real squared_distance) {
    return !uniform_kernel                ? kernel_weight(squared_distance)
           : squared_distance < real(1.0) ? real(0.5)
                                          : real(0.0);
}
