# %% name="no S" sentence="The gain divides by S: multiply by its inverse." must_say=["S|invers"] kind="value"
def update(state, covariance, measurement, H, R):
    gain = covariance @ H.T
    new_state = state + gain @ (measurement - H @ state)
    return new_state, (np.eye(len(state)) - gain @ H) @ covariance

# %% name="state second" sentence="Return the state first." must_say=["first|order"] kind="shape"
def update(state, covariance, measurement, H, R):
    S = H @ covariance @ H.T + R
    gain = covariance @ H.T @ np.linalg.inv(S)
    new_state = state + gain @ (measurement - H @ state)
    return (np.eye(len(state)) - gain @ H) @ covariance, new_state
