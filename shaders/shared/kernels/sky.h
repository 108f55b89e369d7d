// Looks at the sky's picture, and samples it. Reads the buffer `sky`, whose words
// shared/sky_record.h describes.

FN real sky_float(uint word) { return real(bits_float(sky[word])); }
FN vec2 sky_float2(uint word) { return vec2(sky_float(word), sky_float(word + 1u)); }
FN vec3 sky_float3(uint word) {
    return vec3(sky_float(word), sky_float(word + 1u), sky_float(word + 2u));
}

FN uint row_of_sky(uint row) { return sky_row_0 + sky_row_words * row; }
FN vec2 border_of_sky(uint row) { return sky_float2(row_of_sky(row) + 2u); }

FN uint cells_of_sky(uint row) { return row_of_sky(sky[sky_height] + 2u) + sky[sky_width] * row; }

FN vec3 texel_of_sky(uint row, uint column) {
    uint first = cells_of_sky(sky[sky_height] + 1u);
    uint at = first + sky_texel_words * (sky[sky_width] * row + column);
    return sky_radiance(uvec2(sky[at], sky[at + 1u]));
}

FN SkyCorners corners_of_cell(IN(SkyCell) cell) {
    uint right = cell.column + 1u < sky[sky_width] ? cell.column + 1u : 0u;
    uint top = max(cell.row, 1u) - 1u;
    uint bottom = min(cell.row, sky[sky_height] - 1u);
    SkyCorners c;
    c.top_left = texel_of_sky(top, cell.column);
    c.top_right = texel_of_sky(top, right);
    c.bottom_left = texel_of_sky(bottom, cell.column);
    c.bottom_right = texel_of_sky(bottom, right);
    return c;
}

// The place in the picture of a unit vector in the picture's frame.
FN SkyCell cell_of_sky(vec3 d) {
    uint width = sky[sky_width];
    uint height = sky[sky_height];
    SkyCell cell;
    real across = (turn_of(d.z, d.x) + real(0.5)) * real(width) - real(0.5);
    across = across < real(0.0) ? across + real(width) : across;
    cell.column = min(uint(across), width - 1u);
    cell.x = clamp(across - real(cell.column), real(0.0), LARGEST_BELOW_1);
    real from_top = turn_of(sqrt(d.x * d.x + d.z * d.z), d.y) * real(2.0);
    cell.row = min(uint(from_top * real(height) + real(0.5)), height);
    cell.y = share_above(halved_angle(d), border_of_sky(cell.row), border_of_sky(cell.row + 1u));
    return cell;
}

// How many of sky_digits belong to a cell.
FN uint digits_of_cell(uint row, uint column) {
    uint first = cells_of_sky(row) + column;
    return (column + 1u < sky[sky_width] ? sky[first + 1u] : sky_digits) - sky[first];
}

// Density with which sample_sky finds a point by its brightness alone.
FN real density_of_sky(IN(SkyCell) cell, IN(SkyCorners) corners) {
    real mean = brightness_of_cell(corners);
    real here = sky_brightness(radiance_in_cell(corners, cell.x, cell.y));
    real digits = real(digits_of_cell(cell.row, cell.column));
    real of_row = sky_float(row_of_sky(cell.row) + 1u);
    return mean > real(0.0) ? of_row * (digits / SKY_DIGITS) * (here / mean) : real(0.0);
}

FN Cone cone_of_sun() {
    Cone c;
    c.axis = sky_float3(sun_towards);
    c.sine2 = sky_float(sun_sine2);
    c.height = sky_float(sun_height);
    return c;
}

// What is seen in this direction of the world. pdf: whether its density is asked for.
FN SkyPoint sky_at(vec3 towards, bool pdf) {
    vec3 d = to_picture(towards, sky_float2(sky_turn));
    SkyCell cell = cell_of_sky(d);
    SkyCorners corners = corners_of_cell(cell);
    SkyPoint p;
    p.radiance = radiance_in_cell(corners, cell.x, cell.y);
    p.pdf = pdf ? density_of_sky(cell, corners) : real(0.0);
    Cone sun = cone_of_sun();
    if (sun.height > real(0.0)) {
        real probability = sky_float(sun_probability);
        bool inside = is_in_cone(sun, d);
        p.radiance += inside ? sky_float3(sun_radiance) : vec3(real(0.0));
        p.pdf = (real(1.0) - probability) * p.pdf +
                (inside ? probability / cone_solid_angle(sun) : real(0.0));
    }
    return p;
}

// The last of the ranges that begin at these words and does not begin behind the number.
FN uint find_in_sky(uint first, uint stride, uint count, uint digits) {
    uint found = 0u;
    while (count > 1u) {
        uint half_count = count / 2u;
        if (sky[first + stride * (found + half_count)] <= digits) {
            found += half_count;
            count -= half_count;
        } else {
            count = half_count;
        }
    }
    return found;
}

// Where in a range of digits a number is, in [0, 1). u: the number over sky_digits.
FN real within_range(uint first, uint count, real u) {
    real digits = u * SKY_DIGITS;
    uint whole = uint(digits);
    real rest = digits - real(whole);
    return min((real(whole - first) + rest) / real(count), LARGEST_BELOW_1);
}

// A point of the picture, in proportion to its brightness but for the shares that cells have
// anyway; u in [0, 1)².
FN SkyCell sample_cell_of_sky(vec2 u) {
    uint width = sky[sky_width];
    SkyCell cell;
    cell.row = find_in_sky(sky_row_0, sky_row_words, sky[sky_height] + 1u, uint(u.y * SKY_DIGITS));
    uint start = sky[row_of_sky(cell.row)];
    u.y = within_range(start, sky[row_of_sky(cell.row + 1u)] - start, u.y);
    uint cells = cells_of_sky(cell.row);
    cell.column = find_in_sky(cells, 1u, width, uint(u.x * SKY_DIGITS));
    u.x = within_range(sky[cells + cell.column], digits_of_cell(cell.row, cell.column), u.x);
    SkyCorners corners = corners_of_cell(cell);
    vec2 rows = brightness_of_rows(corners);
    cell.y = sample_linear(rows.x, rows.y, u.y);
    vec2 sides = brightness_of_sides(corners, cell.y);
    cell.x = sample_linear(sides.x, sides.y, u.x);
    return cell;
}

FN vec3 direction_of_cell(IN(SkyCell) cell) {
    real turn = (real(cell.column) + real(0.5) + cell.x) / real(sky[sky_width]) - real(0.5);
    vec2 angle = mix(border_of_sky(cell.row), border_of_sky(cell.row + 1u), cell.y);
    return sky_direction(turn, angle);
}

// A direction of the world towards the sky, with the density that sky_at tells; u in [0, 1)².
FN vec3 sample_sky(vec2 u) {
    vec2 turn = sky_float2(sky_turn);
    real probability = sky_float(sun_probability);
    if (u.x < probability) {
        return from_picture(sample_cone(cone_of_sun(), vec2(u.x / probability, u.y)), turn);
    }
    u.x = min((u.x - probability) / (real(1.0) - probability), LARGEST_BELOW_1);
    return from_picture(direction_of_cell(sample_cell_of_sky(u)), turn);
}

// Samples a direction of the sky's picture; see light_from_picture.
FN LightRecord sample_picture(LightRecord light, vec2 u) {
    vec3 towards = sample_sky(u);
    SkyPoint p = sky_at(towards, true);
    return light_from_picture(light, towards, p.radiance, p.pdf);
}
