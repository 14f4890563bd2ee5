# %% name="no transposition" sentence="The second F is transposed: F @ covariance @ F.T." must_say=["F\\.T"] must_not_say=["value by value"] kind="value"
def predict(state, covariance, F, Q):
    return F @ state, F @ covariance @ F + Q

# %% name="state only" sentence="Return the covariance as well." must_say=["covariance|two|both"] kind="shape"
def predict(state, covariance, F, Q):
    return F @ state
