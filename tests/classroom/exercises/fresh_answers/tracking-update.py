# %% name="plus the expected measurement" origin="fresh" sentence="The surprise is the measurement minus H @ state." must_say=["minus|difference"] kind="value"
def update(state, covariance, measurement, H, R):
    S = H @ covariance @ H.T + R
    gain = covariance @ H.T @ np.linalg.inv(S)
    new_state = state + gain @ (measurement + H @ state)
    return new_state, (np.eye(len(state)) - gain @ H) @ covariance

# %% name="only the difference" origin="fresh" sentence="Add the correction to the state." must_say=["add|state"] kind="value"
def update(state, covariance, measurement, H, R):
    S = H @ covariance @ H.T + R
    gain = covariance @ H.T @ np.linalg.inv(S)
    new_state = gain @ (measurement - H @ state)
    return new_state, (np.eye(len(state)) - gain @ H) @ covariance

# %% name="R in the covariance" origin="fresh" sentence="R belongs to S only." must_say=["R|S"] kind="value"
def update(state, covariance, measurement, H, R):
    S = H @ covariance @ H.T + R
    gain = covariance @ H.T @ np.linalg.inv(S)
    new_state = state + gain @ (measurement - H @ state)
    return new_state, (np.eye(len(state)) - gain @ H) @ covariance + gain @ R @ gain.T

# %% name="without H in the covariance" origin="fresh" sentence="The gain must be multiplied by H: gain @ H." must_say=["H|match|shape|broadcast"] kind="error"
def update(state, covariance, measurement, H, R):
    S = H @ covariance @ H.T + R
    gain = covariance @ H.T @ np.linalg.inv(S)
    new_state = state + gain @ (measurement - H @ state)
    return new_state, (np.eye(len(state)) - gain) @ covariance

# %% name="half and half" origin="fresh" sentence="The gain says how far to go; it is not always one half." must_say=["gain|half"] kind="value"
def update(state, covariance, measurement, H, R):
    S = H @ covariance @ H.T + R
    gain = covariance @ H.T @ np.linalg.inv(S)
    new_state = state + 0.5 * np.linalg.pinv(H) @ (measurement - H @ state)
    return new_state, (np.eye(len(state)) - gain @ H) @ covariance
