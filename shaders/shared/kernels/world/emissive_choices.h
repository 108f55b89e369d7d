// Divides the probability of each row of the table of lights among the row's lights, in proportion
// to power.

FN real weight_of(uint light) {
    vec3 power = light_power(lights[light], 1u << light_triangle, real(0.0));
    return power.x + power.y + power.z;
}

// The lights of a row.
FN EmissivePart lights_of(uint row) {
    EmissivePart range;
    range.first = row;
    range.count = 1u;
    if (row >= params.first_light && row - params.first_light < params.parts) {
        EmissivePart part = parts[row - params.first_light];
        range.first = params.first_light + part.first;
        range.count = part.count;
    } else if (row >= params.first_light) {
        range.first = row - params.parts + params.triangles;
    }
    return range;
}

FN real weight_of_all(IN(EmissivePart) range) {
    real sum = real(0.0);
    real rest = real(0.0);
    for (uint k = 0u; k < range.count; ++k) {
        add_without_loss(sum, rest, weight_of(range.first + k));
    }
    return sum + rest;
}

// A share of so many steps.
FN uint share_of(uint steps, real share) {
    real product = min(real(steps) * share, real(4294967040.0)); // the largest below 2^32
    return share > real(0.0) ? min(uint(product), steps) : 0u;
}

// A light's probability is that with which the digits choose it, whatever is rounded. Those that
// are never chosen do not have 0, by which samples would be divided.
FN void main() {
    uint row = THREAD_INDEX;
    if (row >= params.rows) {
        return;
    }
    EmissivePart range = lights_of(row);
    LightChoice choice = rows[row];
    uint steps = rows[row + 1u].before - choice.before;
    real all = range.count > 1u ? weight_of_all(range) : real(0.0);
    bool divides = all > real(0.0) && is_finite(all);
    real sum = real(0.0);
    real rest = real(0.0);
    uint begin = 0u;
    for (uint k = 0u; k < range.count; ++k) {
        uint end = steps;
        if (k + 1u < range.count) {
            add_without_loss(sum, rest, weight_of(range.first + k));
            end = divides ? max(share_of(steps, (sum + rest) / all), begin) : 0u;
        }
        LightChoice of_light = choice;
        of_light.before = choice.before + begin;
        of_light.probability = real(max(end - begin, 1u)) * real(2.3283064365386963e-10);
        light_choices[params.first_choice + range.first + k] = of_light;
        begin = end;
    }
}
