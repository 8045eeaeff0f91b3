(** * Bounds from derivatives

    Claim.  A function is given with its first r derivatives f 0, f 1, ..., f r
    on a closed interval.

    - If E and its derivatives below the n-th vanish at 0 and the n-th is at most
      M x^j / j!, then |E(h)| <= M h^(j + n) / (j + n)!.
    - If r >= 1, f 0 has a primitive, and the integral is its difference.

    Source.  Textbook calculus: the mean value theorem and the fundamental theorem.

    Assumptions.  Derivatives are two-sided, ends of the interval included.

    Every error bound of a quadrature rule is drawn from here: the error of one
    panel is a function of the panel's width that vanishes at width 0. *)

From Coq Require Import Reals Lra Lia.
From Coquelicot Require Import Coquelicot.
Open Scope R_scope.

(** f 1, ..., f r are the derivatives of f 0 on [a, b]. *)
Definition derivatives (r : nat) (f : nat -> R -> R) (a b : R) : Prop :=
  forall k x, (k < r)%nat -> a <= x <= b -> is_derive (f k) x (f (S k) x).

Lemma derivatives_within (r : nat) (f : nat -> R -> R) (a b a' b' : R) :
  derivatives r f a b -> a <= a' -> b' <= b -> derivatives r f a' b'.
Proof. intros Hf Ha Hb k x Hk Hx. apply Hf; [easy | lra]. Qed.

Lemma continuous_of_derivative (f : R -> R) (x l : R) : is_derive f x l -> continuous f x.
Proof. intros Hf. apply (ex_derive_continuous (V := R_NormedModule)). now exists l. Qed.

(** x^j / j!, the derivative of the same with j + 1 for j. *)
Definition taylor_term (j : nat) (x : R) : R := x ^ j / INR (fact j).

Lemma taylor_term_derivative (j : nat) (x : R) :
  is_derive (taylor_term (S j)) x (taylor_term j x).
Proof.
  unfold taylor_term. rewrite fact_simpl, mult_INR. auto_derive; [easy |].
  change (pred (S j)) with j. field.
  split; [apply INR_fact_neq_0 | now apply (not_0_INR (S j))].
Qed.

Lemma taylor_term_0 (j : nat) : taylor_term (S j) 0 = 0.
Proof. unfold taylor_term. rewrite pow_i by lia. unfold Rdiv. ring. Qed.

Lemma nondecreasing (F F' : R -> R) (h : R) :
  0 <= h -> (forall x, 0 <= x <= h -> is_derive F x (F' x)) ->
  (forall x, 0 <= x <= h -> 0 <= F' x) -> F 0 <= F h.
Proof.
  intros Hh HF Hpos.
  destruct (MVT_gen F 0 h F') as [c [Hc difference]];
    rewrite Rmin_left, Rmax_right in * by lra.
  - intros x Hx. apply HF. lra.
  - intros x Hx. apply continuity_pt_filterlim, (continuous_of_derivative F x (F' x)), HF, Hx.
  - assert (0 <= F' c * (h - 0)) by (apply Rmult_le_pos; [now apply Hpos | lra]). lra.
Qed.

(** Integration of a bound. *)
Lemma bound_from_derivative (E E' : R -> R) (j : nat) (M h : R) :
  0 <= h -> (forall x, 0 <= x <= h -> is_derive E x (E' x)) -> E 0 = 0 ->
  (forall x, 0 <= x <= h -> Rabs (E' x) <= M * taylor_term j x) ->
  Rabs (E h) <= M * taylor_term (S j) h.
Proof.
  intros Hh HE E0 HM.
  assert (one_side : forall s, Rabs s = 1 -> s * E h <= M * taylor_term (S j) h).
  { intros s Hs.
    cut (M * taylor_term (S j) 0 - s * E 0 <= M * taylor_term (S j) h - s * E h).
    { rewrite taylor_term_0, E0. lra. }
    apply (nondecreasing (fun x => M * taylor_term (S j) x - s * E x)
      (fun x => M * taylor_term j x - s * E' x)); [easy | |]; intros x Hx.
    - apply (is_derive_minus (V := R_NormedModule)); apply is_derive_scal;
        [apply taylor_term_derivative | now apply HE].
    - assert (H := HM x Hx). rewrite <- (Rmult_1_l (Rabs (E' x))), <- Hs, <- Rabs_mult in H.
      assert (s * E' x <= Rabs (s * E' x)) by apply Rle_abs. lra. }
  apply Rabs_le. split.
  - cut (-1 * E h <= M * taylor_term (S j) h); [lra |].
    apply one_side. rewrite Rabs_left; lra.
  - rewrite <- (Rmult_1_l (E h)). apply one_side, Rabs_R1.
Qed.

Lemma bound_from_derivatives (n j : nat) (E : nat -> R -> R) (M h : R) :
  0 <= h -> derivatives n E 0 h -> (forall k, (k < n)%nat -> E k 0 = 0) ->
  (forall x, 0 <= x <= h -> Rabs (E n x) <= M * taylor_term j x) ->
  Rabs (E 0%nat h) <= M * taylor_term (n + j) h.
Proof.
  revert E h. induction n as [| n IH]; intros E h Hh HE E0 HM; [apply HM; lra |].
  apply bound_from_derivative with (E 1%nat); [easy | | apply E0; lia |]; intros x Hx.
  - apply HE; [lia | easy].
  - apply (IH (fun k => E (S k))); [lra | | |].
    + intros k y Hk Hy. apply HE; [lia | lra].
    + intros k Hk. apply E0. lia.
    + intros y Hy. apply HM. lra.
Qed.

(** A primitive F of f 0 put in front of it. *)
Definition with_primitive (F : R -> R) (f : nat -> R -> R) (k : nat) : R -> R :=
  match k with O => F | S k => f k end.

(** The primitive of what continues f 0 by constants outside of [a, b]. *)
Lemma primitive_exists (r : nat) (f : nat -> R -> R) (a b : R) :
  (1 <= r)%nat -> a <= b -> derivatives r f a b ->
  exists F, derivatives (S r) (with_primitive F f) a b.
Proof.
  intros Hr Hab Hf. set (clamp x := Rmax a (Rmin b x)).
  assert (inside : forall x, a <= clamp x <= b).
  { intros x. split; [apply Rmax_l | apply Rmax_lub; [easy | apply Rmin_l]]. }
  assert (clamp_continuous : forall x, continuous (fun y => f 0%nat (clamp y)) x).
  { intros x. apply continuous_comp.
    - apply continuity_pt_filterlim. unfold clamp.
      assert (lipschitz : forall u v, Rabs (clamp u - clamp v) <= Rabs (u - v)).
      { intros u v. unfold clamp, Rmax, Rmin.
        repeat destruct Rle_dec; unfold Rabs; repeat destruct Rcase_abs; lra. }
      intros e He. exists e. split; [easy |]. intros y [_ Hy].
      eapply Rle_lt_trans; [apply lipschitz | exact Hy].
    - apply continuous_of_derivative with (f 1%nat (clamp x)). apply Hf; [lia | apply inside]. }
  exists (RInt (fun y => f 0%nat (clamp y)) a). intros [| k] x Hk Hx; [| apply Hf; [lia | easy]].
  assert (fixed : clamp x = x) by (unfold clamp; rewrite Rmin_right, Rmax_right; lra).
  simpl. rewrite <- fixed at 2.
  apply (is_derive_RInt (V := R_NormedModule)) with (f := fun y => f 0%nat (clamp y)) (a := a).
  - apply filter_forall. intros y.
    apply (RInt_correct (V := R_CompleteNormedModule)).
    now apply (ex_RInt_continuous (V := R_CompleteNormedModule)).
  - apply clamp_continuous.
Qed.

Lemma integral_by_primitive (r : nat) (F : nat -> R -> R) (a b u v : R) :
  (1 <= r)%nat -> derivatives (S r) F a b -> a <= u <= v -> v <= b ->
  RInt (F 1%nat) u v = F 0%nat v - F 0%nat u.
Proof.
  intros Hr HF Hu Hv. apply is_RInt_unique.
  apply (is_RInt_derive (V := R_CompleteNormedModule) (F 0%nat) (F 1%nat));
    intros x; rewrite Rmin_left, Rmax_right by lra; intros Hx.
  - apply HF; [lia | lra].
  - apply continuous_of_derivative with (F 2%nat x). apply HF; [lia | lra].
Qed.

Lemma derivatives_integrable (r : nat) (f : nat -> R -> R) (a b u v : R) :
  (1 <= r)%nat -> derivatives r f a b -> a <= u <= v -> v <= b -> ex_RInt (f 0%nat) u v.
Proof.
  intros Hr Hf Hu Hv. apply (ex_RInt_continuous (V := R_CompleteNormedModule)).
  intros x. rewrite Rmin_left, Rmax_right by lra. intros Hx.
  apply continuous_of_derivative with (f 1%nat x). apply Hf; [lia | lra].
Qed.
