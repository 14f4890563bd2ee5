# %% name="the step alone" sentence="Add the step to the poses." must_say=["add"] kind="value"
def graph_step(poses, edges):
    J = np.zeros((3 * len(edges), 3 * len(poses)))
    errors, weights = [], []
    for k, (i, j, motion, (place, angle)) in enumerate(edges):
        error, by_first, by_second = linearize(poses[i], poses[j], motion)
        J[3 * k:3 * k + 3, 3 * i:3 * i + 3] = by_first
        J[3 * k:3 * k + 3, 3 * j:3 * j + 3] = by_second
        errors.extend(error)
        weights.extend([place, place, angle])
    J, W = J[:, 3:], np.diag(weights)
    step = np.linalg.solve(J.T @ W @ J, -J.T @ W @ np.array(errors))
    return np.vstack([[0, 0, 0], step.reshape(-1, 3)])

# %% name="W only right" sentence="W is missing in J.T @ W @ J." must_say=["W"] kind="value"
def graph_step(poses, edges):
    J = np.zeros((3 * len(edges), 3 * len(poses)))
    errors, weights = [], []
    for k, (i, j, motion, (place, angle)) in enumerate(edges):
        error, by_first, by_second = linearize(poses[i], poses[j], motion)
        J[3 * k:3 * k + 3, 3 * i:3 * i + 3] = by_first
        J[3 * k:3 * k + 3, 3 * j:3 * j + 3] = by_second
        errors.extend(error)
        weights.extend([place, place, angle])
    J, W = J[:, 3:], np.diag(weights)
    step = np.linalg.solve(J.T @ J, -J.T @ W @ np.array(errors))
    result = poses.copy()
    result[1:] += step.reshape(-1, 3)
    return result
