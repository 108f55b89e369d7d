// The number in the image of a pixel of the film.
FN uint pixel_in_image(uint in_film) {
    if (!cropped) {
        return in_film;
    }
    return (batch.crop_y + in_film / batch.crop_width) * batch.width + batch.crop_x +
           in_film % batch.crop_width;
}
