// The spheres at which photons from lights inside the scene are aimed.
FN Targets scene_targets() {
    SceneRecord s = scene[0];
    Targets targets;
    targets.spheres[0] = vec4(s.target_0);
    targets.spheres[1] = vec4(s.target_1);
    targets.spheres[2] = vec4(s.target_2);
    targets.spheres[3] = vec4(s.target_3);
    targets.count = s.target_count;
    targets.share = s.target_share;
    targets.view = vec4(s.view);
    targets.view_share = s.view_share;
    return targets;
}
